# SPDX-License-Identifier: GPL-3.0-or-later
"""The page: figures.json as HTML, with its style and script inside."""

from __future__ import annotations

import json
import os
import re
from html import escape
from pathlib import Path
from string import Template

from scenes.driver.arguments import ROOT
from scenes.gallery import curve
from scenes.gallery.figures import FIGURES

FOLDER = Path(__file__).resolve().parent
GROUPS = {
    "samples": "{paths_per_pixel} paths per pixel",
    "time": "{seconds:g} seconds",
    "reference": "converged",
    "all": "all light",
    "classes": "light of some paths alone",
}
# Which pictures are shown first, left and right, if a figure has them.
FIRST = (("samples-pt", "samples-bdpt"), ("time-bdpt", "time-vcm"), ("all", "opaque"))
FIRST += (("all", "caustics"),)
CLOCKS = {"wall": "on the wall", "cpu": "that of the processors over the number of threads"}
UNEVEN = 1.1  # ratio of processor times that is worth a word
COLUMNS = ("paths per pixel", "time, s", "CPU, s", "RMSE", "relMSE", "trimmed", "brightness")


def write(gallery: dict, folder: Path) -> None:
    """Writes folder/index.html, which needs nothing but the pictures beside it."""
    link = os.path.relpath(ROOT, folder).replace(os.sep, "/")
    figures = gallery["figures"]
    parts = {
        "style": _read("page.css"),
        "script": _read("page.js"),
        # "</" would end the script element.
        "data": json.dumps(gallery).replace("</", "<\\/"),
        "contents": "\n".join(
            f'<li><a href="#{f["name"]}">{escape(f["title"])}</a></li>' for f in figures
        ),
        "sections": "\n".join(_section(figure, link) for figure in figures),
        "notes": _notes(gallery, link),
    }
    text = Template(_read("page.html")).substitute(parts)
    (folder / "index.html").write_text(text, encoding="utf-8")


def _read(name: str) -> str:
    return (FOLDER / name).read_text(encoding="utf-8").strip()


def marked(text: str, link: str) -> str:
    """A little Markdown as HTML; links are paths from the root of the tree, which is at `link`."""
    text = escape(text, quote=False)
    text = re.sub(r"`([^`]+)`", r"<code>\1</code>", text)
    text = re.sub(r"\[([^]]+)\]\(([^)]+)\)", rf'<a href="{escape(link)}/\2">\1</a>', text)
    text = re.sub(r"\*\*([^*<>]+)\*\*", r"<strong>\1</strong>", text)
    return re.sub(r"(?<![\w*.)])\*([^*<>]+)\*(?![\w*])", r"<em>\1</em>", text)


def number(value: float) -> str:
    """Three digits, in powers of ten where they would be far from the point; as page.js does."""
    if value == 0:
        return "0"
    if 0.01 <= abs(value) < 1000:
        digits = f"{value:#.3g}".rstrip(".")
        return digits
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa}e{int(exponent):+d}"


def _section(figure: dict, link: str) -> str:
    texts = "\n".join(f"<p>{marked(text, link)}</p>" for text in FIGURES[figure["name"]].text)
    wide = " wide" if figure["width"] > 1.2 * figure["height"] else ""
    beside = _thumbnails(figure)
    if "reference" in figure:
        beside = (
            _table(figure)
            + "\n"
            + curve.draw(
                {
                    label: [(point["time"], point["trimmed"]) for point in points]
                    for label, points in figure["curves"].items()
                }
            )
        )
    title = escape(figure["title"])
    return f"""<section id="{figure["name"]}">
<h2>{title}</h2>
{texts}
<div class="stage{wide}">
{_compare(figure)}
<div>
{beside}
</div>
</div>
</section>"""


def _compare(figure: dict) -> str:
    pictures = {picture["key"]: picture for picture in figure["pictures"]}
    first = next(pair for pair in FIRST if set(pair) <= set(pictures))
    label = escape(figure["title"], quote=True)
    images = "\n".join(
        f'<img class="{side}" src="{pictures[key]["file"]}" alt="{escape(pictures[key]["label"])}"'
        f' width="{figure["width"]}" height="{figure["height"]}" draggable="false">'
        for side, key in (("right", first[1]), ("left", first[0]))
    )
    menus = "\n".join(
        f'<label>{side.capitalize()} picture <select class="{side}">{_options(figure, key)}'
        "</select></label>"
        for side, key in zip(("left", "right"), first, strict=True)
    )
    errors = ""
    if "reference" in figure:
        errors = (
            '<label class="errors"><input type="checkbox"> show errors instead: black none, white '
            "as large as the pixel itself</label>"
        )
    return f"""<figure class="compare" data-figure="{figure["name"]}">
<div class="view">
{images}
<div class="bar"></div>
<span class="tag of-left"></span>
<span class="tag of-right"></span>
<input type="range" min="0" max="100" step="0.5" value="50" autocomplete="off"
 aria-label="{label}: how much of the left picture is shown">
</div>
<div class="menus">
{menus}
{errors}
</div>
</figure>"""


def _options(figure: dict, chosen: str) -> str:
    text, group = "", None
    for picture in figure["pictures"]:
        if picture["group"] != group:
            text += "</optgroup>" if group else ""
            group = picture["group"]
            text += f'<optgroup label="{escape(_group(figure, group))}">'
        selected = " selected" if picture["key"] == chosen else ""
        label = escape(picture["label"])
        text += f'<option value="{escape(picture["key"])}"{selected}>{label}</option>'
    return text + "</optgroup>"


def _group(figure: dict, group: str) -> str:
    text = GROUPS[group].format(**figure)
    return f"{text} of the processors" if group == "time" and figure["clock"] == "cpu" else text


def _table(figure: dict) -> str:
    rows, group = "", None
    measured = [picture for picture in figure["pictures"] if "relmse" in picture]
    for picture in measured:
        if picture["group"] != group:
            group = picture["group"]
            own = [p for p in measured if p["group"] == group]
            best = {name: min(p[name] for p in own) for name in ("rmse", "relmse", "trimmed")}
            head = escape(_group(figure, group))
            rows += f'<tr><th scope="rowgroup" colspan="{len(COLUMNS) + 1}">{head}</th></tr>\n'
        errors = {}
        for name, smallest in best.items():
            mark = " best" if picture[name] == smallest else ""
            errors[name] = f'<span class="{name}{mark}">{number(picture[name])}</span>'
        spread = picture["relmse_error"]
        if spread is not None:
            errors["relmse"] += f" ± {number(spread)}"
        cells = [f"{picture['samples']:.0f}", f"{picture['seconds']:.2f}", f"{picture['cpu']:.2f}"]
        cells += [*errors.values(), f"{picture['brightness']:.3f}"]
        rows += f'<tr data-key="{picture["key"]}"><th scope="row">{escape(picture["label"])}</th>'
        rows += "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>\n"
    head = "".join(f'<th scope="col">{column}</th>' for column in COLUMNS)
    return f"""<div class="scroll">
<table>
<caption>Errors against the reference; smaller is better, bold the smallest</caption>
<thead><tr><th scope="col">way</th>{head}</tr></thead>
<tbody>
{rows}</tbody>
</table>
</div>
<p class="note">{_about_reference(figure)}</p>"""


def _about_reference(figure: dict) -> str:
    reference = figure["reference"]
    text = (
        f"Reference: bidirectional, {reference['seconds']:g} s, with an error of its own of "
        f"{number(reference['relmse'])}."
    )
    if reference["path_tracer_differs"] is not None:
        expected = reference["relmse"] + reference["path_tracer_relmse"]
        text += (
            f" A path tracer's picture of the same time differs from it by "
            f"{number(reference['path_tracer_differs'])}; the errors of both explain "
            f"{number(expected)}."
        )
    measured = [p["relmse"] for p in figure["pictures"] if "relmse" in p]
    if reference["relmse"] > 0.1 * min(measured):
        text += (
            " The reference's own error is more than a tenth of the smallest one in the table: "
            "small differences mean nothing."
        )
    if _uneven(figure):
        text += (
            " The machine had other work to do, and the ways to render have had unequal shares of "
            "its processors: see the column CPU."
        )
    return text


def _uneven(figure: dict) -> bool:
    """Whether equal time has not been equal processor time."""
    times = [picture["cpu"] for picture in figure["pictures"] if picture["group"] == "time"]
    return max(times) > UNEVEN * min(times)


def _thumbnails(figure: dict) -> str:
    """All pictures of a figure that has no errors, small, with their shares of the light."""
    items = ""
    for picture in figure["pictures"]:
        share = ""
        if "share" in picture:
            share = f'<span class="share">{100 * picture["share"]:.1f} %</span> of the light'
        items += (
            f'<li data-key="{picture["key"]}"><img src="{picture["file"]}" alt="" '
            f'width="{figure["width"]}" height="{figure["height"]}">'
            f"{escape(picture['label'])}<br>{share}</li>\n"
        )
    return f"""<ul class="thumbnails">
{items}</ul>
<p class="note">Bidirectional, {figure["seconds"]:g} s.</p>"""


def _notes(gallery: dict, link: str) -> str:
    made, definitions = gallery["made"], gallery["definitions"]
    minutes, seconds = divmod(round(made["seconds"]), 60)
    seeds = made["seeds"]
    lines = [
        "*x* is the picture, *r* the reference: "
        + "; ".join(f"**{name}**: {text}" for name, text in definitions.items())
        + ".",
        f"Each error is the mean over {seeds} renders with seeds of their own, with its standard "
        "error; the picture shown is the first of them. What is compared alternates, in one "
        f"process with {made['threads']} threads. *Time* is that of the render alone, on the "
        "wall, *CPU* that of all threads together: export and building the scene are in neither. "
        f"Equal time is {CLOCKS[made['clock']]}. Renders end with a whole pass over the picture.",
        "At equal samples a path per pixel is a path from the eye, a path from the light, or one "
        "of each with all pairs of their vertices joined, as in the lecture. *Bidirectional* at "
        "equal time is what Janus does unless told otherwise: light vertices are cached, each "
        "vertex from the eye is joined with one of them, and how many light paths and joins are "
        "worth their time is measured first.",
        "Theory: [core/THEORY.md](core/THEORY.md). Pictures of every strategy: "
        "[core/LECTURE.md](core/LECTURE.md). Against other renderers: `./dev bench scenes`. All "
        "numbers of this page: figures.json beside it.",
        f"Made by Janus {made['version']} with Blender {made['blender']} and `./dev gallery "
        f"--quality {made['quality']}` in {minutes} min {seconds} s, with at most "
        f"{made['peak_memory_mb']:.0f} MB of memory, Blender included.",
    ]
    return "\n".join(f"<p>{marked(line, link)}</p>" for line in lines)
