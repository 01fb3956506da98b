// SPDX-License-Identifier: GPL-3.0-or-later
// Without it the page shows its first pictures, half and half; with it, the sliders move.
"use strict";

const { figures } = JSON.parse(document.getElementById("figures").textContent);
const byName = new Map(figures.map((figure) => [figure.name, figure]));

// As the tables write it.
function number(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 0.01 && size < 1000 ? value.toPrecision(3) : value.toExponential(1);
}

for (const box of document.querySelectorAll(".compare")) {
  const pictures = new Map(byName.get(box.dataset.figure).pictures.map((p) => [p.key, p]));
  const slider = box.querySelector("input[type=range]");
  const errors = box.querySelector("input[type=checkbox]");
  const sides = ["left", "right"].map((name) => ({
    image: box.querySelector(`img.${name}`),
    tag: box.querySelector(`.tag.of-${name}`),
    menu: box.querySelector(`select.${name}`),
  }));

  function move() {
    box.style.setProperty("--at", `${slider.value}%`);
    const [left, right] = sides.map((side) => pictures.get(side.menu.value).label);
    slider.setAttribute("aria-valuetext",
      `${slider.value} per cent ${left}, the rest ${right}`);
  }

  function show(side) {
    const picture = pictures.get(side.menu.value);
    const error = Boolean(errors && errors.checked && picture.error_file);
    side.image.src = error ? picture.error_file : picture.file;
    side.image.alt = (error ? "Errors of: " : "") + picture.label;
    side.tag.textContent = picture.label +
      (picture.relmse === undefined ? "" : `, relMSE ${number(picture.relmse)}`);
    move();
  }

  slider.addEventListener("input", move);
  for (const side of sides) side.menu.addEventListener("change", () => show(side));
  if (errors) errors.addEventListener("change", () => sides.forEach(show));
  sides.forEach(show); // a browser may have kept the menus of the last visit
}
