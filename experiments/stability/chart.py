#!/usr/bin/env python3
"""In: results.csv, results-long.csv (more rays, Sahl alone; it may be absent) and formulae.csv, as the benchmarks next_hit
and formulae write them. Out: results.md, formulae.md and chart.svg beside them: wrong events per million against
nanoseconds an event, each method on the same rays.

    build/release/benchmarks/next_hit --rays 2000 --csv experiments/stability/results.csv
    build/release/benchmarks/next_hit --rays 100000 --method sahl --no-time --csv experiments/stability/results-long.csv
    build/release/benchmarks/formulae 1000000 experiments/stability/formulae.csv
    experiments/stability/chart.py
"""
import csv
import math
import pathlib
from collections import defaultdict
from xml.sax.saxutils import escape

HERE = pathlib.Path(__file__).resolve().parent
METHODS = ["plain loop", "fixed epsilon", "relative epsilon", "integer offset", "error-bound offset",
           "exclude last triangle", "sahl without contact", "sahl", "sahl quadratic", "sahl fitted"]
COLOURS = ["#888888", "#e69f00", "#b8860b", "#56b4e9", "#0072b2", "#cc79a7", "#7fbf7f", "#007a3d", "#d55e00", "#660033"]


def median(values):
    values = sorted(values)
    return values[len(values) // 2] if values else math.nan


def pooled(rows):
    """Wrong events per million over all cases, each case with the same weight; median time."""
    rates = [1e6 * int(r["wrong"]) / int(r["events"]) for r in rows]
    return sum(rates) / len(rates), median([float(r["ns_per_event"]) for r in rows])


def long_table(rows):
    """Sahl alone, on many rays: what is wrong or left open by rounding."""
    by_method = defaultdict(list)
    for r in rows:
        by_method[r["method"]].append(r)
    out = ["", "Sahl on more rays:", ""]
    for method, mine in by_method.items():
        total = {k: sum(int(r[k]) for r in mine) for k in ("rays", "events", "wrong", "ambiguous")}
        out.append(f"- {method}: {len(mine)} cases, {total['rays']} rays, {total['events']} events, {total['wrong']} wrong, {total['ambiguous']} ambiguous")
    open_ones = [r for r in rows if r["wrong"] != "0" or r["ambiguous"] != "0"]
    if open_ones:
        out += ["", "| case | of | method | rays | events | wrong | ambiguous |", "|---|---|---|---|---|---|---|"]
    for r in open_ones:
        out.append(f"| {r['case']} | {r['of']} | {r['method']} | {r['rays']} | {r['events']} | {r['wrong']} | {r['ambiguous']} |")
    return out


def write_tables(rows, more_rows):
    by_method = defaultdict(list)
    by_case = defaultdict(dict)
    for r in rows:
        by_method[r["method"], r["of"]].append(r)
        by_case[r["case"], r["of"]][r["method"]] = r
    out = ["# Results, as measured", "",
           "| method | of | cases | events | wrong | ambiguous | wrong per million (mean over cases) | cases without a wrong event | ns an event (median) |",
           "|---|---|---|---|---|---|---|---|---|"]
    for method in METHODS:
        for of in ("mesh", "exact", "mixed"):
            mine = by_method.get((method, of))
            if mine:
                rate, ns = pooled(mine)
                total = {k: sum(int(r[k]) for r in mine) for k in ("events", "wrong", "ambiguous")}
                clean = sum(r["wrong"] == "0" for r in mine)
                out.append(f"| {method} | {of} | {len(mine)} | {total['events']} | {total['wrong']} | {total['ambiguous']} "
                           f"| {rate:.3g} | {clean} | {ns:.0f} |")
    if more_rows:
        out += long_table(more_rows)
    out += ["", "Wrong events per million, case by case; in brackets what the method's own rounding leaves open.", "",
            "| case | of | events (sahl) | " + " | ".join(METHODS) + " |", "|---|---|---|" + "---|" * len(METHODS)]
    for (case, of), cells in by_case.items():
        def cell(method):
            r = cells.get(method)
            if not r:
                return "–"
            text = f"{1e6 * int(r['wrong']) / int(r['events']):.3g}"
            return text + (f" [{1e6 * int(r['ambiguous']) / int(r['events']):.2g}]" if r["ambiguous"] != "0" else "")
        events = cells["sahl"]["events"] if "sahl" in cells else ""
        out.append(f"| {case} | {of} | {events} | " + " | ".join(cell(m) for m in METHODS) + " |")
    (HERE / "results.md").write_text("\n".join(out) + "\n")


def write_chart(rows):
    width, height, left, top, right, bottom = 900, 560, 90, 50, 690, 480
    by_method = defaultdict(list)
    for r in rows:
        if r["of"] == "mesh" and float(r["ns_per_event"]) > 0:
            by_method[r["method"]].append(r)
    low, high = 1.5, 4.5  # powers of ten of ns
    floor, ceiling = -1.0, 6.0  # of wrong events per million; at the floor: none at all

    def x(ns):
        return left + (right - left) * (min(max(math.log10(ns), low), high) - low) / (high - low)

    def y(rate):
        at = floor if rate <= 0 else min(max(math.log10(rate), floor + 0.5), ceiling)
        return bottom - (bottom - top) * (at - floor) / (ceiling - floor)

    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">',
           f'<rect width="{width}" height="{height}" fill="white"/>',
           f'<text x="{left}" y="28" font-size="16">Wrong events per million against cost, meshes of the torture suite</text>']
    for power in range(0, 7):
        svg.append(f'<line x1="{left}" x2="{right}" y1="{y(10 ** power):.1f}" y2="{y(10 ** power):.1f}" stroke="#ddd"/>'
                   f'<text x="{left - 8}" y="{y(10 ** power) + 4:.1f}" text-anchor="end">{10 ** power:,}</text>')
    svg.append(f'<line x1="{left}" x2="{right}" y1="{bottom}" y2="{bottom}" stroke="#000"/>'
               f'<text x="{left - 8}" y="{bottom + 4}" text-anchor="end">none</text>')
    for ns in (50, 100, 200, 500, 1000, 2000, 5000, 10000, 20000):
        svg.append(f'<line x1="{x(ns):.1f}" x2="{x(ns):.1f}" y1="{top}" y2="{bottom}" stroke="#eee"/>'
                   f'<text x="{x(ns):.1f}" y="{bottom + 20}" text-anchor="middle">{ns}</text>')
    svg.append(f'<text x="{(left + right) / 2}" y="{bottom + 44}" text-anchor="middle">CPU nanoseconds an event (small: a case; large: mean over cases, median time)</text>')
    for number, (method, colour) in enumerate(zip(METHODS, COLOURS)):
        mine = by_method.get(method, [])
        if not mine:
            continue
        for r in mine:
            rate = 1e6 * int(r["wrong"]) / int(r["events"])
            svg.append(f'<circle cx="{x(float(r["ns_per_event"])):.1f}" cy="{y(rate):.1f}" r="3" fill="{colour}" fill-opacity="0.35"/>')
        rate, ns = pooled(mine)
        svg.append(f'<circle cx="{x(ns):.1f}" cy="{y(rate):.1f}" r="9" fill="{colour}" stroke="#000"/>')
        svg.append(f'<circle cx="{right + 22}" cy="{top + 22 * number + 10}" r="7" fill="{colour}"/>'
                   f'<text x="{right + 36}" y="{top + 22 * number + 15}">{escape(method)}</text>')
    svg.append("</svg>")
    (HERE / "chart.svg").write_text("\n".join(svg) + "\n")


def write_formulae(text):
    shares, directions = text.split("\n\n")
    out = ["# Worst errors of the formulae, as measured", "",
           "ulp: of values whose error is above 1e-16; absolute beside it. `balance` is |R + T − 1|, the worst of s, p and unpolarised; "
           "`wrong` counts wrong decisions on total internal reflection.", "",
           "| regime | inputs | R_s ulp | R_p ulp | T_s ulp | T_p ulp | R abs | T abs | balance | wrong |", "|---|---|---|---|---|---|---|---|---|---|"]
    for r in csv.DictReader(shares.splitlines()):
        most = {k: max(float(r[f"abs_{k}_s"]), float(r[f"abs_{k}_p"])) for k in "RT"}
        out.append(f"| {r['regime']} | {r['inputs']} | " + " | ".join(f"{float(r['ulp_' + k]):.1f}" for k in ("R_s", "R_p", "T_s", "T_p"))
                   + f" | {most['R']:.1e} | {most['T']:.1e} | {float(r['balance']):.1e} | {r['wrong_total']} |")
    out += ["", "Directions, from two vectors in space. The last column is the largest |k₂²|/n₁² at which vectors that are unit but for rounding "
            "were decided otherwise than the vectors they stand for (0: never).", "",
            "| regime | inputs | refracted, rad | reflected, rad | length | decided otherwise within |", "|---|---|---|---|---|---|"]
    for r in csv.DictReader(directions.splitlines()):
        out.append(f"| {r['regime']} | {r['inputs']} | {float(r['refracted_rad']):.1e} | {float(r['reflected_rad']):.1e} "
                   f"| {float(r['length']):.1e} | {float(r['wrong_total_within']):.1e} |")
    (HERE / "formulae.md").write_text("\n".join(out) + "\n")


if __name__ == "__main__":
    with open(HERE / "results.csv", encoding="utf-8") as file:
        measured = list(csv.DictReader(file))
    more = []
    if (HERE / "results-long.csv").exists():
        with open(HERE / "results-long.csv", encoding="utf-8") as file:
            more = list(csv.DictReader(file))
    write_tables(measured, more)
    write_chart(measured)
    write_formulae((HERE / "formulae.csv").read_text(encoding="utf-8"))
