// Dark or light: as the system has it, until someone says otherwise.

export type Theme = "dark" | "light";

export class Themes {
  #asked = $state<Theme | null>(null);
  #system = $state<Theme>("dark");
  readonly theme = $derived(this.#asked ?? this.#system);

  constructor(private readonly shelf: Pick<Storage, "getItem" | "setItem"> = localStorage) {
    const light = matchMedia("(prefers-color-scheme: light)");
    this.#system = light.matches ? "light" : "dark";
    light.addEventListener("change", () => (this.#system = light.matches ? "light" : "dark"));
    const kept = this.shelf.getItem("mien theme");
    if (kept === "dark" || kept === "light") this.#asked = kept;
  }

  toggle(): void {
    this.#asked = this.theme === "dark" ? "light" : "dark";
    this.shelf.setItem("mien theme", this.#asked);
  }
}
