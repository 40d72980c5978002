import { mount } from "svelte";
import Demo from "./demo/Demo.svelte";
import "./theme.css";
import "./controls/controls.css";

const theme = new URLSearchParams(location.search).get("theme");
if (theme) document.documentElement.dataset.theme = theme;
export default mount(Demo, { target: document.getElementById("demo")! });
