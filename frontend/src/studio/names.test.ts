import { expect, it } from "vitest";
import { cleanName, stemOf } from "./names";

it("leaves an honest name as it is", () => {
  for (const name of ["walk", "Gang müde 2", "歩く", "v1.2 final", "_x", "constant"])
    expect(cleanName(name, "bvh")).toBe(name);
  expect(stemOf("a.b.bvh")).toBe("a.b");
});

it("takes the ending away where it was typed too", () => {
  expect(cleanName("walk.BVH", "bvh")).toBe("walk");
  expect(cleanName("walk.mien.json", "mien.json")).toBe("walk");
  expect(cleanName("walk.toml", "bvh")).toBe("walk.toml");
});

it("is never a path, nor what a system does not take", () => {
  expect(cleanName("../../etc/passwd", "bvh")).toBe("etc_passwd");
  expect(cleanName("C:\\Users\\me\\walk", "bvh")).toBe("C__Users_me_walk");
  expect(cleanName("/", "bvh")).toBe("");
  expect(cleanName(" ..hidden. ", "bvh")).toBe("hidden");
  expect(cleanName('a<b>c:"d|e?f*', "bvh")).toBe("a_b_c_d_e_f_");
  expect(cleanName("walk\u202Ehvb.exe\n", "bvh")).toBe("walk_hvb.exe");
  expect(cleanName("NUL", "bvh")).toBe("_NUL");
  expect(cleanName("com1.x", "bvh")).toBe("_com1.x");
  expect([...cleanName("ü".repeat(300), "bvh")]).toHaveLength(100);
});
