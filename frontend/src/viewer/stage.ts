// The room: light, floor with a grid of metres, fog, and the same in dark.
import {
  Color, DirectionalLight, Fog, HemisphereLight, Mesh, MeshLambertMaterial, PlaneGeometry, Scene, Vector2,
  type IUniform,
} from "three";

export type Theme = "light" | "dark";

const THEMES = {
  light: { air: "#eceff2", floor: "#e3e7eb", line: "#9aa4ae", sky: "#ffffff", earth: "#b9b2a8", sky_light: 2.1, sun: 1.9 },
  dark: { air: "#1d2126", floor: "#2a3037", line: "#5d6873", sky: "#dfe8f5", earth: "#5c5a58", sky_light: 1.7, sun: 1.9 },
} as const;
const REACH = 3.2; // metres around what is followed that the sun's shadow covers
const FAR = 60; // half the side of the floor

export class Stage {
  readonly scene = new Scene();
  #sky = new HemisphereLight();
  #sun = new DirectionalLight();
  #floor: Mesh<PlaneGeometry, MeshLambertMaterial>;
  #line: IUniform<Color> = { value: new Color() };
  #shift: IUniform<Vector2> = { value: new Vector2() };
  #lines: IUniform<number> = { value: 1 };

  constructor(theme: Theme, shadows: boolean) {
    this.#sun.castShadow = shadows;
    this.#sun.shadow.mapSize.set(2048, 2048);
    this.#sun.shadow.radius = 2.5;
    this.#sun.shadow.bias = -0.0004;
    this.#sun.shadow.normalBias = 0.02;
    const seen = this.#sun.shadow.camera;
    seen.left = seen.bottom = -REACH;
    seen.right = seen.top = REACH;
    seen.far = 14;
    this.#floor = new Mesh(new PlaneGeometry(2 * FAR, 2 * FAR), new MeshLambertMaterial());
    this.#floor.rotation.x = -Math.PI / 2;
    this.#floor.receiveShadow = true;
    this.#floor.material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, { lineColour: this.#line, shift: this.#shift, lines: this.#lines });
      shader.vertexShader = shader.vertexShader
        .replace("void main() {", "varying vec2 onFloor;\nvoid main() {\nonFloor = (modelMatrix * vec4(position, 1.)).xz;");
      shader.fragmentShader = shader.fragmentShader
        .replace("void main() {", `${GRID}\nvoid main() {`)
        .replace("#include <color_fragment>", "diffuseColor.rgb = ruled(diffuseColor.rgb);");
    };
    this.scene.add(this.#sky, this.#sun, this.#sun.target, this.#floor);
    this.scene.fog = new Fog(0, 9, 30);
    this.theme = theme;
    this.lookAt(0, 0);
  }

  set theme(theme: Theme) {
    const colours = THEMES[theme];
    this.scene.background = new Color(colours.air);
    this.scene.fog!.color.set(colours.air);
    this.#floor.material.color.set(colours.floor);
    this.#line.value.set(colours.line);
    this.#sky.color.set(colours.sky);
    this.#sky.groundColor.set(colours.earth);
    this.#sky.intensity = colours.sky_light;
    this.#sun.intensity = colours.sun;
  }

  set grid(shown: boolean) {
    this.#lines.value = shown ? 1 : 0;
  }

  /** Let the fog begin behind what is looked at from `distance`. */
  set distance(distance: number) {
    const fog = this.scene.fog as Fog;
    fog.near = 1.6 * distance + 3;
    fog.far = 4 * distance + 14;
  }

  /** Light the surroundings of a place on the floor, and lay floor there. */
  lookAt(x: number, z: number): void {
    this.#floor.position.set(x, 0, z);
    this.#sun.target.position.set(x, 0.8, z);
    this.#sun.position.set(x + 2.4, 6, z + 3);
  }

  /** Let the grid slide below a figure that is kept in place. */
  slide(x: number, z: number): void {
    this.#shift.value.set(x, z);
  }

  dispose(): void {
    this.#floor.geometry.dispose();
    this.#floor.material.dispose();
    this.#sun.dispose();
  }
}

/** Lines every metre, and faint ones every quarter, as wide as a pixel and gone where they would blur. */
const GRID = `
varying vec2 onFloor;
uniform vec3 lineColour;
uniform vec2 shift;
uniform float lines;

float near(vec2 place, float wide) {
  vec2 pixel = max(fwidth(place), 1e-6);
  vec2 away = abs(fract(place - 0.5) - 0.5) / pixel;
  vec2 fade = 1.0 - smoothstep(0.15, 0.6, pixel);
  vec2 line = (1.0 - smoothstep(wide - 0.5, wide + 0.5, away)) * fade;
  return max(line.x, line.y);
}

vec3 ruled(vec3 plain) {
  vec2 place = onFloor + shift;
  float line = max(0.8 * near(place, 0.75), 0.22 * near(4.0 * place, 0.5));
  return mix(plain, lineColour, lines * line);
}`;
