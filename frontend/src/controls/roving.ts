// Many buttons as one stop of Tab: the arrows move among them, as WAI-ARIA has it for toolbars.

/** Which of `count` buttons in rows of `columns` a key leads to from `at`; null for other keys. */
export function moved(key: string, at: number, count: number, columns: number): number | null {
  const last = count - 1;
  const to: Record<string, number> = {
    ArrowRight: Math.min(at + 1, last),
    ArrowLeft: Math.max(at - 1, 0),
    // Where there is no row above or below, it stays.
    ArrowDown: at + columns <= last ? at + columns : at,
    ArrowUp: at - columns >= 0 ? at - columns : at,
    Home: 0,
    End: last,
  };
  return to[key] ?? null;
}

/** How many stand in a row as high as the first. */
export function columnsOf(tops: readonly number[]): number {
  const below = tops.findIndex((top) => top > tops[0]!);
  return below < 0 ? tops.length : below;
}
