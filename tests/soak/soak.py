#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random studies through every command, in every way to compute them; invariants on every result.

soak.py SUNLOAD [--count N] [--seed S]     N studies (default 20); the seed is printed (default: of the clock)
soak.py SUNLOAD --seed S --only K          study K of that seed alone; --keep FOLDER leaves it there
                   --no-estimates          of time and memory, which sanitizers and debugging change
soak.py SUNLOAD --self-test                good results, each broken: every invariant must see it
"""

import argparse
import json
import os
import pathlib
import random
import shutil
import sys
import tempfile
import time
import traceback

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "end_to_end"))

import estimates
import invariants
import other_ways
from commands import Commands
from program import DONE, WRONG_INPUT, Program
from random_study import RandomStudy
from result import read_result

# Ledgers and comparisons of a study, at the most: variants; objects of two transports.
TESTS_PER_STUDY = 20
COMMANDS_PER_STUDY = 3
TOLD_EVERY = 50


def refused(program, study):
    """A study that is wrong: check and run say the same, and nothing is left."""
    for words in (("check",), ("run",), ("run", "--shard", "0/2"), ("merge",)):
        yield from program.run(words[0], "study.yaml", *words[1:]).problems(WRONG_INPUT)
    if os.path.exists(os.path.join(study.folder, "results")):
        yield "a study that is refused leaves a folder of results"


class Soak:
    def __init__(self, sunload, seed, count, measures):
        self.sunload, self.seed, self.measures = os.path.abspath(sunload), seed, measures
        self.tests = count * TESTS_PER_STUDY
        self.ledgers = []  # residual / standard error of gathered results of 8 realizations and more
        self.done = {"refused": 0, "computed": 0, "measured": 0}

    def study_problems(self, study, program):
        checked = program.run("check", "study.yaml", "--json")
        yield from checked.problems(DONE)
        ran = program.run("run", "study.yaml", "--progress", "none")
        yield from ran.problems(DONE)
        if checked.code != DONE or ran.code != DONE:
            return
        self.done["computed"] += 1
        told = json.loads(checked.out)
        if study.is_measurable and self.measures:
            self.done["measured"] += 1
            yield from estimates.of_run(program, told)
        yield from other_ways.left_over(study, "results")
        first = None
        for variant in told["variants"]:
            results = read_result(other_ways.result_path(study, "results", variant["name"]))
            first = first or results
            yield from (f"{variant['name']}: {problem}" for problem in invariants.problems(results))
            if study.is_sound:
                yield from (f"{variant['name']}: {problem}" for problem in invariants.ledger_closes(results, self.tests))
                self.note_ledger(results)
            yield from self.is_as_foretold(variant, results[0])
        if study.is_measurable:
            return  # small studies show all else in less time
        yield from self.other_ways(study, program, ran.wall_s)
        yield from Commands(program, study, first, study.random, self.tests).some(COMMANDS_PER_STUDY)

    def is_as_foretold(self, told, result):
        """What `check` counts is what the result has."""
        for name, found in (("patches", len(result["patch_area"])), ("intervals", len(result["time"])),
                            ("hash", result.attributes["study_sha256"])):
            if told[name] != found:
                yield f"{told['name']}: check foretold {name} {told[name]}, the result has {found}"

    def note_ledger(self, results):
        if (test := invariants.ledger_tests(results)) and results[0].realizations >= 8 and test[1] > 0:
            self.ledgers.append(test[0] / test[1])

    def other_ways(self, study, program, whole_s):
        luck = study.random
        ways = [other_ways.with_threads, other_ways.in_shards, other_ways.by_and_by, other_ways.in_other_batches,
                lambda *words: other_ways.killed(*words, whole_s)]
        yield from luck.choice(ways)(program, study, luck)
        if study.is_sound and luck.random() < 0.15:
            yield from other_ways.by_other_transport(program, study, luck, self.tests)

    def problems(self, number, folder):
        """Of one study; what the soak itself stumbles on counts as one."""
        try:
            study = RandomStudy(f"{self.seed}/{number}", folder)
            program = Program(self.sunload, folder)
            if study.is_wrong:
                self.done["refused"] += 1
                return list(refused(program, study))
            return list(self.study_problems(study, program))
        except Exception:  # whatever it is, this study showed it
            return [traceback.format_exc()]

    def run(self, numbers, keep):
        failed = []
        for number in numbers:
            folder = keep or tempfile.mkdtemp(prefix="soak-")
            os.makedirs(folder, exist_ok=True)
            found = self.problems(number, folder)
            if number > 0 and number % TOLD_EVERY == 0:
                print(f"... {number} studies, {len(failed)} failed", flush=True)
            if not keep:
                shutil.rmtree(folder)
            if found:
                failed.append(number)
                print(f"study {number}: {len(found)} problems; again: soak.py SUNLOAD --seed {self.seed} --only {number}")
                print("".join(f"  {problem}\n" for problem in found[:8]), flush=True)
        return failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sunload")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--only", type=int)
    parser.add_argument("--keep")
    parser.add_argument("--no-estimates", action="store_true")
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    if options.self_test:
        import planted_faults
        return planted_faults.main(os.path.abspath(options.sunload))
    seed = options.seed if options.seed is not None else random.SystemRandom().randrange(10 ** 6)
    numbers = range(options.count) if options.only is None else [options.only]
    print(f"soak of {len(numbers)} studies, seed {seed}", flush=True)
    begin = time.monotonic()
    soak = Soak(options.sunload, seed, options.count, not options.no_estimates)
    failed = soak.run(numbers, options.keep)
    within = sum(abs(z) < 2 for z in soak.ledgers)
    print(f"seed {seed}: {len(numbers)} studies in {time.monotonic() - begin:.0f} s: {soak.done['computed']} computed "
          f"({soak.done['measured']} measured against their estimates), {soak.done['refused']} wrong ones refused; "
          f"{within} of {len(soak.ledgers)} ledgers within 2 standard errors; {len(failed)} failed: {failed}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
