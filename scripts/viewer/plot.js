// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The time series of a patch.
import { roundedUp, shown } from "./scale.js";

const colours = ["#0072B2", "#D55E00"];
const left = 46, right = 8, top = 18, bottom = 24;

/** Intervals that the plot shows: the day of interval k where there are many, else all. */
function span(times, k) {
  if (times.length <= 200) return [0, times.length];
  const day = times[k].local_begin.slice(0, 10);
  const inside = times.map((time, i) => (time.local_begin.slice(0, 10) === day ? i : -1)).filter((i) => i >= 0);
  return [inside[0], inside[inside.length - 1] + 1];
}

/** `curves`: label and one value per interval. Intervals stand side by side; gaps of the period are vertical lines. */
export function drawSeries(canvas, times, k, curves, caption) {
  const c = canvas.getContext("2d"), { width, height } = canvas, [first, last] = span(times, k);
  const largest = Math.max(0, ...curves.flatMap((curve) => curve.values.slice(first, last)).filter(Number.isFinite));
  const end = largest > 0 ? roundedUp(largest) : 1;
  const x = (i) => left + ((i - first) / (last - first)) * (width - left - right);
  const y = (value) => height - bottom - (value / end) * (height - top - bottom);
  c.clearRect(0, 0, width, height);
  c.font = "11px sans-serif";
  c.fillStyle = "#333";
  c.fillText(caption, left, 11);
  c.strokeStyle = "#ddd";
  c.textAlign = "right";
  for (const value of [0, end / 2, end]) {
    c.beginPath();
    c.moveTo(left, y(value));
    c.lineTo(width - right, y(value));
    c.stroke();
    c.fillText(shown(value), left - 4, y(value) + 4);
  }
  c.strokeStyle = "#bbb";
  c.textAlign = "left";
  let written = -Infinity;
  for (let i = first; i < last; ++i) {
    const isNew = i === first || times[i].local_begin.slice(0, 10) !== times[i - 1].local_begin.slice(0, 10);
    const clock = times[i].local_begin.slice(11, 16);
    if (i > first && times[i].begin > times[i - 1].end + 1) {
      c.beginPath();
      c.moveTo(x(i), top);
      c.lineTo(x(i), height - bottom);
      c.stroke();
    }
    const text = isNew ? `${times[i].local_begin.slice(5, 10)} ${clock}` : clock;
    if ((isNew || clock.endsWith(":00")) && x(i) > written + 14 && x(i) + c.measureText(text).width < width) {
      c.fillText(text, x(i), height - 8);
      written = x(i) + c.measureText(text).width;
    }
  }
  c.fillStyle = "rgba(242,169,0,0.25)";
  c.fillRect(x(k), top, Math.max(1, x(k + 1) - x(k)), height - top - bottom);
  curves.forEach((curve, n) => {
    c.strokeStyle = colours[n];
    c.lineWidth = 1.6;
    c.setLineDash(n ? [5, 3] : []);
    c.beginPath();
    for (let i = first; i < last; ++i) {
      if (!Number.isFinite(curve.values[i])) continue;
      const isJoined = i > first && Number.isFinite(curve.values[i - 1]) && times[i].begin <= times[i - 1].end + 1;
      isJoined ? c.lineTo(x(i), y(curve.values[i])) : c.moveTo(x(i), y(curve.values[i]));
      c.lineTo(x(i + 1), y(curve.values[i]));
    }
    c.stroke();
    c.setLineDash([]);
    if (curves.length > 1) {
      c.fillStyle = colours[n];
      c.fillText(curve.label, width - 150 + n * 76, 11);
    }
  });
  c.lineWidth = 1;
}
