#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Shows that the stability catalogue can fail: removes one guard at a time and expects a case to go red.

    tests/stress/mutate.py            every mutation: copies HEAD to build/mutations, builds the
                                      command there and runs the cases named; prints a table
    tests/stress/mutate.py --check    only that each mutation still fits the sources

The exit code is 0 just when every mutation was noticed (or fits)."""

import argparse
import pathlib
import shutil
import subprocess
import sys
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parents[2]


@dataclass
class Mutation:
    guard: str
    cases: str  # for --only
    edits: list  # of (file, text that stands there once, what to put instead)


MUTATIONS = [
    Mutation("doubles decide where an edge function is zero", "leaks/", [
        ("model/geometry/watertight.h", "return hit_in_double(s, hit);", "return false;"),
        ("model/traversal/packet_triangle-inl.h",
         "lanes = (lanes & ~unsure) | decide_in_double(s, unsure, hit);",
         "lanes = lanes & ~unsure & (decide_in_double(s, unsure, hit) | ~LaneMask{0});")]),
    Mutation("planes widened by the rounding of the test", "rays/", [
        ("model/traversal/ray_setup-inl.h", "6.0F * kHalfUlp", "0.0F * kHalfUlp")]),
    Mutation("planes widened by the rounding of the moved origin", "rays/", [
        ("model/traversal/ray_setup-inl.h", "2.0F * kHalfUlp", "0.0F * kHalfUlp")]),
    Mutation("a plane at 0 * infinity counts for both sides", "rays/", [
        ("model/traversal/simd-inl.h", "return hn::Min(a, b);", "return hn::Min(b, a);"),
        ("model/traversal/simd-inl.h", "return hn::Max(a, b);", "return hn::Max(b, a);")]),
    Mutation("equal t goes to the lower primitive", "rays/degenerate", [
        ("model/traversal/packet_triangle-inl.h", "hn::And(hn::Eq(hit.t, limit), lower));",
         "hn::And(hn::Eq(hit.t, limit), hn::Not(lower)));")]),
    Mutation("origins leave their surface", "secondary/", [
        ("model/shading/ray_offset.h",
         "return {offset_coordinate(p.x, n.x, scale), offset_coordinate(p.y, n.y, scale),",
         "return scale.unit > 0.0F ? p : Vec3{offset_coordinate(p.x, n.x, scale), "
         "offset_coordinate(p.y, n.y, scale),")]),
    Mutation("large triangles are left by a share of their size", "secondary/", [
        ("model/shading/ray_offset.h", "reach > 64.0F ? 0x1p-20F * reach : 0.0F",
         "0.0F * reach")]),
    Mutation("far scenes are left by ulps of their largest coordinate", "secondary/sphere moved", [
        ("model/shading/ray_offset.h", "largest > 256.0F * std::max(", "largest > 1e30F * std::max(")]),
    Mutation("small scenes have a small unit", "secondary/tiny", [
        ("model/shading/ray_offset.h", "if (!(largest < 0.25F)) return 1.0F;",
         "if (!(largest < 0.0F)) return 1.0F;")]),
    Mutation("weights saturate", "light/overflow", [
        ("model/shading/saturate.h",
         "x > 0.0F ? std::min(x, std::numeric_limits<float>::max()) : 0.0F", "std::min(x, x)")]),
    Mutation("films take only finite contributions that are not negative", "sums/no numbers", [
        ("model/image/film.cpp", "return x >= 0.0F && x <= kFloatMax;",
         "return x >= 0.0F || x <= kFloatMax || x != x;")]),
    Mutation("the exact sum carries between its words", "sums/", [
        ("model/image/exact_sum.h", "high += words_[word] < low ? 1 : 0;",
         "high += words_[word] < low ? 0 : 0;")]),
    Mutation("the exact sum is rounded to nearest", "sums/", [
        ("model/image/exact_sum.cpp",
         "if (half && ((mantissa & 1U) != 0 || any_below(words_, shift - 1))) {",
         "if (half && any_below(words_, shift - 1) && false) {")]),
    Mutation("unorm8 rounds to nearest", "sums/", [
        ("model/image/film.cpp", "static_cast<std::uint8_t>(sum + 0.5)",
         "static_cast<std::uint8_t>(sum)")]),
    Mutation("half rounds once", "sums/", [
        ("model/image/film.cpp", "std::bit_cast<float>(bits | 1U)",
         "std::bit_cast<float>(bits | 0U)")]),
    Mutation("accessors end within their view", "input/beyond the file", [
        ("model/scene/gltf_accessor.cpp",
         "if (offset > bytes.size() || needed > bytes.size() - offset) {",
         "if (offset > bytes.size() + needed) {")]),
    Mutation("views end within their buffer", "input/beyond the file", [
        ("model/scene/gltf_document.cpp",
         "view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset",
         "false")]),
    Mutation("buffers end within their file", "input/beyond the file", [
        ("model/scene/gltf_document.cpp", "if (length > bytes.size()) {", "if (false) {")]),
    Mutation("indices are of vertices", "input/beyond the file", [
        ("model/scene/gltf_primitive.cpp", "if (order[i] >= num_vertices) {", "if (false) {")]),
    Mutation("sparse values end within their view", "input/beyond the file", [
        ("model/scene/gltf_accessor.cpp", "count * element, place + \"/values\"",
         "0 * element, place + \"/values\"")]),
    Mutation("paths lead nowhere up", "input/beyond the folder", [
        ("model/scene/gltf_uri.cpp", "relative.is_absolute() || climbs ||",
         "relative.is_absolute() || (climbs && false) ||")]),
    Mutation("paths are relative", "input/beyond the folder", [
        ("model/scene/gltf_uri.cpp", "relative.is_absolute() || climbs ||", "climbs ||")]),
    Mutation("links lead nowhere else", "input/beyond the folder", [
        ("model/scene/gltf_uri.cpp", "if (error || end != folder_.end()) {",
         "if (error || (end != folder_.end() && false)) {")]),
    Mutation("vertices that no view backs have a limit", "input/beyond memory", [
        ("model/scene/gltf_accessor.cpp", "if (count_ > kMaxZeroElements) {", "if (false) {")]),
    Mutation("files have a limit", "input/beyond memory", [
        ("model/scene/gltf_file.cpp", "if (size > limit) refuse", "if (false) refuse")]),
    Mutation("sides of an image have a limit", "input/beyond memory", [
        ("model/scene/gltf_texture.cpp",
         "std::max(texture.width, texture.height) > kMaxImageSide || texels", "texels")]),
    Mutation("texels of all images have a limit", "input/beyond memory", [
        ("model/scene/gltf_texture.cpp", "|| texels > remaining.texels", "")]),
    Mutation("scans of all images have a limit", "input/beyond memory", [
        ("model/scene/gltf_texture.cpp", "if (scans * texels > remaining) {", "if (false) {")]),
    Mutation("triangles have a limit", "input/beyond memory", [
        ("model/scene/gltf_plan.cpp", "if (plan_.triangles + product > kMaxTriangles) {",
         "if (false) {")]),
    Mutation("instances have a limit", "input/beyond memory", [
        ("model/scene/gltf_nodes.cpp", "if (num_instances_ > kMaxTriangles) {", "if (false) {")]),
    Mutation("a node is reached once", "input/beyond memory", [
        ("model/scene/gltf_nodes.cpp", "if (reached_[next.node]) {", "if (false) {")]),
    Mutation("entries have a limit", "input/beyond memory", [
        ("model/scene/gltf_json.cpp", "value.is_array() && value.size() > kMaxEntries",
         "value.is_array() && false")]),
    Mutation("levels of JSON have a limit", "input/beyond memory", [
        ("model/scene/gltf_json.cpp", "if (++depth > kMaxJsonDepth) {", "if (++depth < 0) {")]),
    Mutation("time that SystemC cannot say is refused", "machines/slow clock", [
        ("model/channels/clock_domain.h", "if (to > last_cycle_) refuse_time(to);", "")]),
    Mutation("who waits for room in a link is woken", "machines/stiff", [
        ("model/units/primary_source.cpp", "out_packets->notify_when_free(inbox_);", "")]),
    Mutation("packets wait for their credits", "machines/against clocked", [
        ("model/units/primary_source.cpp", "if (!flow_.admits(reservation_, now)) {",
         "if (!flow_.admits(reservation_, now) && false) {")]),
    Mutation("the memory's bus is shared", "machines/against clocked", [
        ("model/memory/fixed_dram.cpp", "std::max(now + spec_.latency, bus_free_) + transfer",
         "now + spec_.latency + transfer")]),
    Mutation("latencies of fixed memory are core cycles", "machines/clocks", [
        ("model/memory/fixed_dram.cpp", "std::max(now + spec_.latency, bus_free_)",
         "std::max<Cycles>(now + spec_.latency * 1000 / domain_.period().value(), bus_free_)")]),
    Mutation("cycles are counted in 64 bits", "machines/long runs", [
        ("model/system/machine_report.cpp", "SystemValues::cycles, end_);",
         "SystemValues::cycles, static_cast<std::uint32_t>(end_));")]),
    Mutation("weights are not cut off below", "light/powers", [
        ("model/shading/saturate.h", "return x > 0.0F ?", "return x > 0x1p-24F ?")]),
    Mutation("weights are not cut off above", "light/powers", [
        ("model/shading/saturate.h", "std::min(x, std::numeric_limits<float>::max())",
         "std::min(x, 65504.0F)")]),
    Mutation("a half stands for all that rounds to it", "precision/", [
        ("model/traversal/reduced_precision.cpp",
         "return {stored - 0.5F * ulp, stored + 0.5F * ulp};", "return {stored - 0.0F * ulp, stored + 0.0F * ulp};")]),
    Mutation("a number of few bits stands for its cell", "precision/", [
        ("model/traversal/reduced_precision.cpp",
         "return {std::min(end(cell), value), std::max(end(cell + 1.0), value)};",
         "return {end(cell), end(cell)};")]),
]


def fits(tree: pathlib.Path) -> bool:
    """Whether each edit finds its text exactly once; complains about those that do not."""
    good = True
    for mutation in MUTATIONS:
        for file, old, _ in mutation.edits:
            count = (tree / file).read_text().count(old)
            if count != 1:
                print(f"{mutation.guard}: {file} has {old!r} {count} times, not once",
                      file=sys.stderr)
                good = False
    return good


def copy_head(scratch: pathlib.Path) -> None:
    """The committed sources, all of them new: what an earlier run built may be of mutated ones."""
    for path in scratch.glob("*"):
        if path.name != "build":
            shutil.rmtree(path) if path.is_dir() else path.unlink()
    scratch.mkdir(parents=True, exist_ok=True)
    archive = subprocess.run(["git", "archive", "HEAD"], cwd=ROOT, check=True, capture_output=True)
    subprocess.run(["tar", "-x", "-m", "-C", str(scratch)], input=archive.stdout, check=True)


def build(scratch: pathlib.Path) -> None:
    done = subprocess.run(["cmake", "--build", "build/tests", "--target", "sheaf", "-j2"],
                          cwd=scratch, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"a mutation does not compile:\n{done.stdout}")


def failures(scratch: pathlib.Path, cases: str) -> list:
    """Runs cases; the names of those that fail. A run that stops at an assertion of the simulator
    counts as one too, a run that ends otherwise as none."""
    done = subprocess.run(["build/tests/sheaf", "stability", "--quick", "--only", cases],
                          cwd=scratch, capture_output=True, text=True, timeout=1800)
    if done.returncode == 0:
        return []
    if done.returncode != 1:
        sys.exit(f"exit code {done.returncode}: {done.stderr}")
    failed, case = [], ""
    for line in done.stdout.splitlines():
        if not line.startswith(" "):
            case = line.split(" (")[0]
        elif line.endswith("FAIL") and case not in failed:
            failed.append(case)
    if failed:
        return failed
    bug = done.stderr.strip().splitlines()[-1:]
    if not bug or "bug of the simulator" not in bug[0]:
        sys.exit(f"exit code 1 without a reason: {done.stderr}")
    return [bug[0].split("please report it: ")[-1]]


def try_out(scratch: pathlib.Path, mutation: Mutation) -> list:
    saved = {file: (scratch / file).read_text() for file, _, _ in mutation.edits}
    try:
        for file, old, new in mutation.edits:
            path = scratch / file
            path.write_text(path.read_text().replace(old, new))
        build(scratch)
        return failures(scratch, mutation.cases)
    finally:
        for file, text in saved.items():
            (scratch / file).write_text(text)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="only whether the mutations still fit")
    parser.add_argument("--only", nargs="+", default=[""], help="guards that contain one of these")
    arguments = parser.parse_args()
    if arguments.check:
        return 0 if fits(ROOT) else 1
    scratch = ROOT / "build" / "mutations"
    copy_head(scratch)
    if not fits(scratch):
        return 1
    subprocess.run(["cmake", "--preset", "tests"], cwd=scratch, check=True,
                   stdout=subprocess.DEVNULL)
    print("| guard removed | cases run | cases that fail |\n| --- | --- | --- |", flush=True)
    unnoticed = 0
    for mutation in MUTATIONS:
        if not any(only in mutation.guard for only in arguments.only):
            continue
        failed = try_out(scratch, mutation)
        unnoticed += not failed
        print(f"| {mutation.guard} | {mutation.cases} | {', '.join(failed) or 'NONE'} |", flush=True)
    return 1 if unnoticed else 0


if __name__ == "__main__":
    sys.exit(main())
