// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Light over time of what is chosen: through the day, by hour of day, by day and by month.
import { roundedUp, shown } from "./scale.js";

export const curveColours = ["#0072B2", "#D55E00"];
const left = 46, right = 10, top = 10, bottom = 24, secondsPerHour = 3600, wattsPerKilowatt = 1000;
export const chartNames = { day: "course", hours: "hours", days: "days", months: "months" };

const dayOf = (time) => time.local_begin.slice(0, 10), monthOf = (time) => time.local_begin.slice(0, 7);

/** Charts that a result's times have something to say in. Sun positions without a date have the first alone. */
export function chartsOf(result) {
  if (result.is_synthetic) return ["day"];
  const days = new Set(result.times.map(dayOf)).size, months = new Set(result.times.map(monthOf)).size;
  // Means of days and months say nothing of hours.
  if (result.series_step === "month") return ["months"];
  if (result.series_step === "day") return ["days", ...(months > 1 ? ["months"] : [])];
  return ["day", "hours", ...(days > 1 ? ["days"] : []), ...(months > 1 ? ["months"] : [])];
}

/** Energies per part of the period (kWh of W): [[name, value]]; NaN where nothing is known. */
export function sums(times, values, step, nameOf) {
  const parts = new Map();
  times.forEach((time, i) => {
    const name = nameOf(time), energy = (values[i] * step * (time.end - time.begin)) / secondsPerHour / wattsPerKilowatt;
    if (!parts.has(name)) parts.set(name, NaN);
    if (Number.isFinite(energy)) parts.set(name, (parts.get(name) || 0) + energy);
  });
  return [...parts];
}

/** Means per hour of the civil day, 24 of them; NaN for hours that no interval reaches. */
export function hourMeans(times, values) {
  const sum = new Float64Array(24), seconds = new Float64Array(24);
  times.forEach((time, i) => {
    if (!Number.isFinite(values[i])) return;
    let clock = Number(time.local_begin.slice(11, 13)) * 3600 + Number(time.local_begin.slice(14, 16)) * 60 + Number(time.local_begin.slice(17, 19) || 0);
    for (let rest = time.end - time.begin; rest > 0;) {
      const hour = Math.floor(clock / secondsPerHour) % 24, here = Math.min(rest, (Math.floor(clock / secondsPerHour) + 1) * secondsPerHour - clock);
      sum[hour] += values[i] * here;
      seconds[hour] += here;
      clock += here;
      rest -= here;
    }
  });
  return Array.from(sum, (value, hour) => (seconds[hour] > 0 ? value / seconds[hour] : NaN));
}

/** Bars of a chart: `names` and for each curve one value per name. */
function bars(kind, times, curves) {
  if (kind === "hours") {
    const means = curves.map((curve) => hourMeans(curve.times, curve.values)), isUsed = (hour) => means.some((list) => Number.isFinite(list[hour]));
    const used = [...Array(24).keys()].filter(isUsed), hours = used.length ? [...Array(24).keys()].slice(used[0], used[used.length - 1] + 1) : [];
    return { names: hours.map(String), values: means.map((list) => hours.map((hour) => list[hour])) };
  }
  const nameOf = kind === "days" ? dayOf : monthOf, names = [...new Set(times.map(nameOf))];
  return { names, values: curves.map((curve) => {
    const all = new Map(sums(curve.times, curve.values, curve.step, nameOf));
    return names.map((name) => all.get(name) ?? NaN);
  }) };
}

/** A canvas as sharp as the screen; numbers below are pixels of the page. */
function cleared(canvas) {
  const width = canvas.clientWidth || 350, height = canvas.clientHeight || 170, ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const c = canvas.getContext("2d");
  c.scale(ratio, ratio);
  c.font = "11px 'DejaVu Sans', Verdana, sans-serif";
  return { c, width, height };
}

function drawAxis({ c, width, height }, largest) {
  const end = largest > 0 ? roundedUp(largest) : 1, y = (value) => height - bottom - (value / end) * (height - top - bottom);
  c.strokeStyle = "#ddd";
  c.fillStyle = "#333";
  c.textAlign = "right";
  for (const value of [0, end / 2, end]) {
    c.beginPath();
    c.moveTo(left, y(value));
    c.lineTo(width - right, y(value));
    c.stroke();
    c.fillText(shown(value), left - 4, y(value) + 4);
  }
  c.textAlign = "left";
  return y;
}

const largestOf = (lists) => Math.max(0, ...lists.map((list) => list.reduce((most, value) => (value > most ? value : most), 0)));

/** `names` and for each curve one value per name. */
export function drawBars(canvas, kind, { names, values }) {
  const page = cleared(canvas), { c, width, height } = page;
  const y = drawAxis(page, largestOf(values)), wide = (width - left - right) / Math.max(1, names.length), gap = wide > 6 ? 0.15 * wide : 0;
  let written = -Infinity;
  names.forEach((name, i) => {
    const x = left + i * wide, thin = (wide - gap) / values.length;
    values.forEach((list, n) => {
      if (!Number.isFinite(list[i])) return;
      c.fillStyle = curveColours[n];
      c.fillRect(x + gap / 2 + n * thin, y(list[i]), Math.max(0.5, thin), y(0) - y(list[i]));
    });
    const text = kind === "days" ? name.slice(5) : name, half = c.measureText(text).width / 2, middle = x + wide / 2;
    if (middle - half < written + 6 || middle + half > width) return;
    c.fillStyle = "#333";
    c.fillText(text, middle - half, height - 8);
    written = middle + half;
  });
  return { names, values };
}

/** Intervals that the plot shows: the day of interval k where there are many, else all. */
function span(times, k) {
  if (times.length <= 200) return [0, times.length];
  const inside = times.map((time, i) => (dayOf(time) === dayOf(times[k]) ? i : -1)).filter((i) => i >= 0);
  return [inside[0], inside[inside.length - 1] + 1];
}

/** Intervals stand side by side; gaps of the period are vertical lines. Returns the interval at a place of the canvas. */
function drawDay(canvas, times, k, curves) {
  const page = cleared(canvas), { c, width, height } = page, [first, last] = span(times, k);
  const y = drawAxis(page, largestOf(curves.map((curve) => curve.shown.slice(first, last))));
  const x = (i) => left + ((i - first) / (last - first)) * (width - left - right);
  c.strokeStyle = "#bbb";
  let written = -Infinity;
  const hasFullHours = times.slice(first, last).filter((time) => time.local_begin.slice(14, 16) === "00").length > 2;
  const hasDays = last > first && dayOf(times[first]) !== dayOf(times[last - 1]);
  for (let i = first; i < last; ++i) {
    const isNew = i === first || dayOf(times[i]) !== dayOf(times[i - 1]), clock = times[i].local_begin.slice(11, 16);
    if (i > first && times[i].begin > times[i - 1].end + 1) {
      c.beginPath();
      c.moveTo(x(i), top);
      c.lineTo(x(i), height - bottom);
      c.stroke();
    }
    const text = hasDays ? dayOf(times[i]).slice(5) : isNew ? `${dayOf(times[i]).slice(5)} ${clock}` : clock;
    if ((isNew || (!hasDays && (!hasFullHours || clock.endsWith(":00")))) && x(i) > written + 14 && x(i) + c.measureText(text).width < width) {
      c.fillText(text, x(i), height - 8);
      written = x(i) + c.measureText(text).width;
    }
  }
  c.fillStyle = "rgba(242,169,0,0.25)";
  c.fillRect(x(k), top, Math.max(1, x(k + 1) - x(k)), height - top - bottom);
  curves.forEach(({ shown: values }, n) => {
    c.strokeStyle = curveColours[n];
    c.lineWidth = 1.6;
    c.setLineDash(n ? [5, 3] : []);
    c.beginPath();
    for (let i = first; i < last; ++i) {
      if (!Number.isFinite(values[i])) continue;
      const isJoined = i > first && Number.isFinite(values[i - 1]) && times[i].begin <= times[i - 1].end + 1;
      isJoined ? c.lineTo(x(i), y(values[i])) : c.moveTo(x(i), y(values[i]));
      c.lineTo(x(i + 1), y(values[i]));
    }
    c.stroke();
  });
  return (px) => Math.max(first, Math.min(last - 1, first + Math.floor(((px - left) / (width - left - right)) * (last - first))));
}

/**
 * `curves`: label, own `times`, `values` and `step`, and `shown`: the values at the page's times.
 * Returns what the drawing says: bars, or the interval at a place of the canvas.
 */
export function drawChart(canvas, kind, times, k, curves) {
  if (kind === "day") return { intervalAt: drawDay(canvas, times, k, curves) };
  return drawBars(canvas, kind, bars(kind, times, curves));
}
