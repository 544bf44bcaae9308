#!/usr/bin/env bash
# Drapes one scene of the comparison: run.sh SCENE-FOLDER OUT.obj. TOILE names the program, EXTRA holds further arguments.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
scene=$(cd "$1" && pwd)
case $(basename "$scene") in
S1* | S2*) line=held with="pins" ;;
S3*) line=skirt with="pins body" ;;
S4*) line=panels with="body stitches" ;;
*) echo "no such scene: $scene" >&2; exit 2 ;;
esac
set_of() { case $1 in body) echo "body=$scene/body.obj" ;; *) echo "$1=$scene/$1.txt" ;; esac; }
args=(--set "mesh=$scene/garment.obj")
for what in $with; do args+=(--set "$(set_of "$what")"); done
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
# shellcheck disable=SC2086
"${TOILE:-toile}" run "$here/$line.toml" "${args[@]}" --allow-read "$scene" --out "$out/o" --quiet ${EXTRA:-}  >/dev/null
cp "$out/o/final.obj" "$2"
