// Drawings of 16 by 16, drawn for this project: what is filled, and what is a line 1.5 wide.

export interface Drawing {
  fill?: string;
  line?: string;
}

export const ICONS = {
  play: { fill: "M4 2.5v11l9.5-5.5z" },
  pause: { fill: "M3.5 2.5h3v11h-3zM9.5 2.5h3v11h-3z" },
  reverse: { fill: "M12 2.5v11L2.5 8z" },
  first: { fill: "M2.5 3h2v10h-2zM13.5 3v10L5.5 8z" },
  last: { fill: "M11.5 3h2v10h-2zM2.5 3v10l8-5z" },
  back: { fill: "M11.5 3h2v10h-2zM9.5 3v10L2.5 8z" },
  forward: { fill: "M2.5 3h2v10h-2zM6.5 3v10l7-5z" },
  loop: {
    line: "M3 7.5V6a2.5 2.5 0 0 1 2.5-2.5H13M10.5 1 13 3.5 10.5 6" +
      "M13 8.5V10a2.5 2.5 0 0 1-2.5 2.5H3M5.5 15 3 12.5 5.5 10",
  },
  range: { line: "M2.5 3v10M13.5 3v10M4.5 8h7M6.5 6l-2 2 2 2M9.5 6l2 2-2 2" },
  once: { line: "M2 8h9M8 4.5 11.5 8 8 11.5M14 3v10" },
  plus: { line: "M8 3v10M3 8h10" },
  minus: { line: "M3 8h10" },
  close: { line: "M4 4l8 8M12 4l-8 8" },
  eye: {
    line: "M1.5 8S4 3.5 8 3.5 14.5 8 14.5 8 12 12.5 8 12.5 1.5 8 1.5 8zM8 6a2 2 0 1 0 0 4 2 2 0 0 0 0-4z",
  },
  hidden: { line: "M1.5 8S4 3.5 8 3.5 14.5 8 14.5 8 12 12.5 8 12.5 1.5 8 1.5 8zM3 13.5l10-11" },
  solo: { line: "M8 2a6 6 0 1 0 0 12A6 6 0 0 0 8 2z", fill: "M8 5.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5z" },
  copy: { line: "M5.5 5.5h8v8h-8zM10.5 5.5v-3h-8v8h3" },
  trash: { line: "M2.5 4.5h11M6 4V2.5h4V4M4 4.5l.7 9h6.6l.7-9M6.7 7v4M9.3 7v4" },
  undo: { line: "M6 3 3 6l3 3M3 6h6.5a3.5 3.5 0 0 1 0 7H6" },
  redo: { line: "M10 3l3 3-3 3M13 6H6.5a3.5 3.5 0 0 0 0 7H10" },
  up: { line: "M3.5 10 8 5.5l4.5 4.5" },
  down: { line: "M3.5 6 8 10.5 12.5 6" },
  right: { line: "M6 3.5 10.5 8 6 12.5" },
  grip: { fill: "M5 3h2v2H5zM9 3h2v2H9zM5 7h2v2H5zM9 7h2v2H9zM5 11h2v2H5zM9 11h2v2H9z" },
  key: { fill: "M8 2l6 6-6 6-6-6z" },
  nokey: { line: "M8 3l5 5-5 5-5-5z" },
  keyadd: { fill: "M6 4l5 5-5 5-5-5z", line: "M12.5 1.5v5M10 4h5" },
  edit: { line: "M3 13l.7-3L10.5 3.2l2.3 2.3L6 12.3z" },
  fit: { line: "M2 5V2h3M11 2h3v3M14 11v3h-3M5 14H2v-3M4.5 8h7" },
  zoomin: { line: "M7 2.5a4.5 4.5 0 1 0 0 9 4.5 4.5 0 0 0 0-9zM10.5 10.5 14 14M7 5v4M5 7h4" },
  zoomout: { line: "M7 2.5a4.5 4.5 0 1 0 0 9 4.5 4.5 0 0 0 0-9zM10.5 10.5 14 14M5 7h4" },
  folder: { line: "M1.5 12.5v-9h4.5l1.5 2h7v7z" },
  save: { line: "M2.5 2.5h9l2 2v9h-11zM5 2.5v3.5h5V2.5M4.5 13.5v-4h7v4" },
  share: { line: "M8 10V2M5 4.5 8 1.5l3 3M3 8v5.5h10V8" },
  moon: { line: "M13 9.5A5.5 5.5 0 0 1 6.5 3 5.5 5.5 0 1 0 13 9.5z" },
  sun: {
    line: "M8 5a3 3 0 1 0 0 6 3 3 0 0 0 0-6z" +
      "M8 1v1.5M8 13.5V15M1 8h1.5M13.5 8H15M3 3l1 1M12 12l1 1M13 3l-1 1M4 12l-1 1",
  },
  help: {
    line: "M8 1.5a6.5 6.5 0 1 0 0 13 6.5 6.5 0 0 0 0-13z" +
      "M6 6.2a2 2 0 1 1 2.8 1.8c-.5.3-.8.6-.8 1.3M8 11v.8",
  },
  menu: { line: "M2 4h12M2 8h12M2 12h12" },
  more: { fill: "M2.5 7h2v2h-2zM7 7h2v2H7zM11.5 7h2v2h-2z" },
  good: { line: "M3 8.5l3.5 3.5L13 4.5" },
  warn: { line: "M8 2 1.5 13.5h13zM8 6.5v3.5M8 11.2v1" },
} as const satisfies Record<string, Drawing>;

export type IconName = keyof typeof ICONS;
