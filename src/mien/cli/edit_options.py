"""The options of ``mien edit`` that no other command has."""

from pathlib import Path
from typing import Annotated

import typer

Emotion = Annotated[
    list[str] | None,
    typer.Option(
        "--emotion",
        "-e",
        metavar="WORD",
        help="An emotion word; mien presets lists them. Several, each with its strength: "
        "-e sad=0:1,5:0 -e happy=0:0,5:1 turns sad into happy.",
    ),
]
RecipeFile = Annotated[
    Path | None, typer.Option("--recipe", "-r", help="A recipe file (.toml or .json), or a clip's sidecar.")
]
To = Annotated[
    str | None,
    typer.Option(
        metavar="WORD", help="A word of the circumplex to move to, such as happy, bored or calm, or V,A."
    ),
]
Valence = Annotated[
    float | None, typer.Option(help="Move to this valence: -1 unpleasant, 1 pleasant; 0 without it.")
]
Arousal = Annotated[
    float | None, typer.Option(help="Move to this arousal: -1 calm, 1 intense; 0 without it.")
]
By = Annotated[str, typer.Option(metavar="V,A", help="Move by so much valence and arousal, such as +.3,0.")]
Start = Annotated[
    str,
    typer.Option(metavar="WORD", help="Where the clips are now, a word or V,A; without it in the middle."),
]
Way = Annotated[
    str,
    typer.Option(
        "--method",
        help="How to move there: recipe (presets, as strong as the clip needs), plain, rules, joint.",
    ),
]
Model = Annotated[
    Path | None,
    typer.Option(
        help="A model that mien learn wrote, to move and to read back by, in place of the shipped one."
    ),
]
FromExample = Annotated[
    Path | None, typer.Option(help="A clip of anyone whose manner to take, on any skeleton.")
]
ExampleNeutral = Annotated[
    Path | None,
    typer.Option(help="The neutral clip that the example differs from; without it, each clip itself."),
]
Strength = Annotated[
    str,
    typer.Option(
        metavar="NUMBER",
        help="How much: 0 changes nothing, 1 as written, up to 2 exaggerates; or times with their values, "
        "such as 0:0,1.5:1.",
    ),
]
Parts = Annotated[
    str, typer.Option(help="Only these body parts, e.g. arms,head (or roles such as left_wrist).")
]
Span = Annotated[str, typer.Option(help="Only from one time to another, in seconds, e.g. 1.0,3.5.")]
Ease = Annotated[
    float | None, typer.Option(help="Seconds that the ends of --span take to set in (0.25 without it).")
]
FootPlant = Annotated[
    bool | None,
    typer.Option(
        "--foot-plant/--no-foot-plant",
        help="Put the feet back on the floor after pose edits (default: yes, or what --recipe says).",
    ),
]
Safe = Annotated[
    bool | None,
    typer.Option(
        "--safe/--no-safe",
        help="Check the result, mend it, and take back what would break the body (default: yes for "
        "emotions, or what --recipe says).",
    ),
]
Sidecar = Annotated[
    bool,
    typer.Option("--sidecar/--no-sidecar", help="Write what was done beside each clip (OUTPUT.recipe.toml)."),
]
Out = Annotated[
    Path | None,
    typer.Option("--out", "-o", help="The file, or the folder, to write to; - is stdout, for one clip."),
]
