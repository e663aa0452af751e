// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is shown as one picture: title, scene with captions, legend and time.
import { drawBarCanvas, isMinor, tickText } from "./legend.js";
import { colourShare } from "./scale.js";
import { caption, fileName, shownText, title } from "./words.js";

const margin = 16, titleHeight = 40, titleLine = 16, captionHeight = 24, barHeight = 36, lineHeight = 14, barWidth = 320, unitsWidth = 90;

/** Lines of swatches that fit a width; calls draw(x, line, swatch) where given. */
function flow(c, swatches, width, draw = () => {}) {
  let x = 0, line = 0;
  for (const swatch of swatches) {
    const wide = 34 + c.measureText(swatch.name).width;
    if (x > 0 && x + wide > width) [x, line] = [0, line + 1];
    draw(x, line, swatch);
    x += wide;
  }
  return line + 1;
}

/** Lines of a text that fit a width. */
function wrapped(c, text, width) {
  const lines = [];
  for (const word of text.split(" ").filter(Boolean)) {
    const longer = lines.length ? `${lines[lines.length - 1]} ${word}` : word;
    if (lines.length && c.measureText(longer).width <= width) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

/** Numbers below a bar; of a logarithmic one those between powers of ten where they have room. */
function drawTicks(c, legend, from, y) {
  const taken = [], ticks = legend.isLogarithmic ? [...legend.ticks].sort((a, b) => isMinor(legend, a) - isMinor(legend, b)) : legend.ticks;
  for (const value of ticks) {
    const text = tickText(legend, value), width = c.measureText(text).width, left = from + colourShare(legend, value) * barWidth - width / 2;
    if (legend.isLogarithmic && taken.some(([begin, end]) => left < end + 4 && left + width > begin - 4)) continue;
    taken.push([left, left + width]);
    c.fillText(text, left, y);
  }
}

function drawScale(c, legend, x, y) {
  c.font = "bold 13px 'DejaVu Sans', Verdana, sans-serif";
  c.fillText(legend.units, x, y + 13);
  const from = x + c.measureText(legend.units).width + 12, bar = document.createElement("canvas");
  drawBarCanvas(bar, legend);
  c.drawImage(bar, from, y, barWidth, 16);
  c.strokeStyle = "#555";
  c.strokeRect(from - 0.5, y - 0.5, barWidth + 1, 17);
  c.font = "12px 'DejaVu Sans', Verdana, sans-serif";
  drawTicks(c, legend, from, y + 30);
  c.fillStyle = "#555";
  legend.beyond.forEach((words, line) => c.fillText(words, from, y + barHeight + 8 + lineHeight * line));
  c.fillStyle = "#222";
  return from + barWidth + 40;
}

/** A canvas with all of it, as sharp as the scene's own. */
export function composed(viewer) {
  viewer.render();
  const scene = viewer.canvas, width = scene.clientWidth, height = scene.clientHeight, ratio = scene.width / width;
  const page = document.createElement("canvas"), c = page.getContext("2d");
  const legends = viewer.legends(), legendHeight = barHeight + lineHeight * (1 + Math.max(1, ...legends.map((one) => one.beyond?.length ?? 0)));
  c.font = "12px 'DejaVu Sans', Verdana, sans-serif";
  const swatches = legends.find((one) => one.swatches)?.swatches;
  const foot = swatches ? 20 * flow(c, swatches, width - 2 * margin) + margin : legends.length ? legendHeight * (legends.length > 1 && width < 2 * (barWidth + unitsWidth) + 80 ? 2 : 1) : 0;
  const told = wrapped(c, shownText(viewer), width - 2 * margin), head = titleHeight + titleLine * told.length;
  page.width = Math.round(width * ratio);
  page.height = Math.round((head + height + foot + margin) * ratio);
  c.scale(ratio, ratio);
  c.fillStyle = "#fff";
  c.fillRect(0, 0, width, page.height);
  c.fillStyle = "#222";
  c.font = "bold 15px 'DejaVu Sans', Verdana, sans-serif";
  c.fillText(title(viewer), margin, 26, width - 2 * margin);
  c.font = "12px 'DejaVu Sans', Verdana, sans-serif";
  told.forEach((line, n) => c.fillText(line, margin, 45 + titleLine * n));
  c.drawImage(scene, 0, head, width, height);
  for (const part of viewer.parts()) {
    const y = head + part.y + part.height;
    c.fillStyle = "#fff";
    c.fillRect(part.x, y, part.width, captionHeight);
    c.fillStyle = "#222";
    c.font = "bold 13px 'DejaVu Sans', Verdana, sans-serif";
    c.textAlign = "center";
    c.fillText(caption(viewer, part), part.x + part.width / 2, y + 17, part.width - 12);
    c.textAlign = "left";
  }
  const top = head + height + 10;
  c.font = "12px 'DejaVu Sans', Verdana, sans-serif";
  if (swatches) {
    c.strokeStyle = "#555";
    flow(c, swatches, width - 2 * margin, (x, line, { colour, name }) => {
      c.fillStyle = colour;
      c.fillRect(margin + x, top + 20 * line, 14, 14);
      c.strokeRect(margin + x + 0.5, top + 20 * line + 0.5, 13, 13);
      c.fillStyle = "#222";
      c.fillText(name, margin + x + 20, top + 20 * line + 12);
    });
  } else {
    let x = margin, y = top;
    for (const legend of legends) {
      x = drawScale(c, legend, x, y);
      if (x + unitsWidth + barWidth > width) [x, y] = [margin, y + legendHeight];
    }
  }
  return page;
}

/** Saves it as a PNG of that name. */
export function savePicture(viewer) {
  composed(viewer).toBlob((blob) => {
    const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: `${fileName(viewer)}.png` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }, "image/png");
}
