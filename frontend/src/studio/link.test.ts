import { describe, expect, it } from "vitest";
import { type Link, linkText, readLink } from "./link";

const LINK: Link = { clip: "a b&c", time: 1.25, mode: "wipe", camera: [0.5, -0.1, 4, 0, 0.9, 0] };

describe("a link to a view", () => {
  it("comes back as it was, also with the page's key", () => {
    expect(readLink(`#${linkText(LINK, "")}`)).toEqual(LINK);
    expect(readLink(`#${linkText(LINK, "key")}`)).toEqual(LINK);
    expect(new URLSearchParams(linkText(LINK, "key")).get("token")).toBe("key");
  });

  it("is none without a clip, and leaves out what makes no sense", () => {
    expect(readLink("#token=abc")).toBeNull();
    expect(readLink("#clip=x&at=-3&mode=upside&camera=1_2_three_4_5_6")).toEqual({
      clip: "x",
      time: 0,
      mode: null,
      camera: null,
    });
    expect(readLink("#clip=x&camera=1_2_3")!.camera).toBeNull();
  });
});
