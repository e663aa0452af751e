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

/** End of the scale of values of which few are above this one. */
export function endAbove(value) { return value > 0 ? roundedUp(value) : 1; }

/** End of the scale: 99.5 % of the area lie below. */
export function scaleEnd(values, area) {
  const known = [];
  values.forEach((value, k) => Number.isFinite(value) && known.push(k));
  known.sort((a, b) => values[a] - values[b]);
  const all = known.reduce((sum, k) => sum + area[k], 0);
  let below = 0;
  for (const k of known) {
    below += area[k];
    if (below >= scaleShare * all) return endAbove(values[k]);
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

/** How near to each other, as shares of a usual bar, numbers at ticks touch. */
function touching(...values) { return values.reduce((share, value) => share + 0.016 * shown(value).length, 0.03); }

/** Ticks with the last colour's value (of differences the first's, too) in place of those that would touch it. */
export function withEnds(scale, list) {
  const ends = scale.low < 0 ? [scale.low, scale.high] : [scale.high], share = (value) => colourShare(scale, value);
  const rest = list.filter((value) => ends.every((end) => Math.abs(share(end) - share(value)) >= touching(end, value)));
  return [...rest, ...ends].sort((a, b) => a - b);
}

// As in `sunload render --scale log`.
const decades = 3;

/** Value of the first colour of a logarithmic scale. */
export function leastOfDecades(high) { return high / 10 ** decades; }

/** Place of a value between those of the first and the last colour: 0 to 1. */
export function colourShare({ low, high, isLogarithmic }, value) {
  if (isLogarithmic && value <= low) return 0;
  const share = isLogarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
  return Math.min(1, Math.max(0, share));
}

/** 1, 2 and 5 times powers of ten from low to high, both above 0. */
export function logarithmicTicks(low, high) {
  const list = [], exponent = (value) => Math.floor(Math.log10(value));
  for (let e = exponent(low); e <= exponent(high * (1 + 1e-9)); ++e)
    for (const digit of [1, 2, 5]) {
      const tick = Number(`${digit}e${e}`);
      if (tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9)) list.push(tick);
    }
  return list;
}

/** Whether a tick is a power of ten: where there is little room, these alone have their numbers. */
export function isPowerOfTen(value) { return Number(`1e${Math.round(Math.log10(value))}`) === value; }

/** Some digits, as people write them. */
export function shown(value, digits = 4) {
  if (!Number.isFinite(value)) return "not known";
  const rounded = Number(value.toPrecision(digits));
  return Math.abs(value) >= 1e7 || (value !== 0 && Math.abs(value) < 1e-3) ? rounded.toExponential() : String(rounded);
}
