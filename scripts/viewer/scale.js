// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Ends and ticks of the legend.

// A few glints must not darken everything else: as in `sunload render`.
const scaleShare = 0.995;

/** Smallest 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 × 10^n that is not below a value above 0. */
export function roundedUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  const digit = [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find((d) => d * power >= value * (1 - 1e-9));
  return Number((digit * power).toPrecision(6));
}

/** End of the scale: 99.5 % of the area lie below. */
export function scaleEnd(values, area) {
  const known = [];
  values.forEach((value, k) => Number.isFinite(value) && known.push(k));
  known.sort((a, b) => values[a] - values[b]);
  const all = known.reduce((sum, k) => sum + area[k], 0);
  let below = 0;
  for (const k of known) {
    below += area[k];
    if (below >= scaleShare * all) return values[k] > 0 ? roundedUp(values[k]) : 1;
  }
  return 1;
}

/** Round numbers from low to high, some five steps. */
export function ticks(low, high) {
  const rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((d) => d * power).find((s) => s >= rough * (1 - 1e-9));
  const list = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high * (1 + 1e-9); ++k) list.push(Number((k * step).toPrecision(12)));
  return list;
}

/** Some digits, as people write them. */
export function shown(value, digits = 4) {
  if (!Number.isFinite(value)) return "not known";
  return Math.abs(value) >= 1e7 || (value !== 0 && Math.abs(value) < 1e-3) ? value.toExponential(digits - 1) : String(Number(value.toPrecision(digits)));
}
