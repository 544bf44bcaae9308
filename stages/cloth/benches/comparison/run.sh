#!/usr/bin/env bash
# Drapes one scene of the comparison: run.sh SCENE-FOLDER OUT.obj. TOILE names the program.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
scene=$(cd "$1" && pwd)
pins=(--set "pins=$scene/pins.txt")
body=(--set "body=$scene/body.obj")
stitches=(--set "stitches=$scene/stitches.txt")
case $(basename "$scene") in
S1* | S2*) line=held sets=("${pins[@]}") ;;
S3*) line=skirt sets=("${pins[@]}" "${body[@]}") ;;
S4*) line=panels sets=("${body[@]}" "${stitches[@]}") ;;
*) echo "no such scene: $scene" >&2 && exit 2 ;;
esac
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
"${TOILE:-toile}" run "$here/$line.toml" --set "mesh=$scene/garment.obj" "${sets[@]}" --allow-read "$scene" --out "$out/o" --quiet >/dev/null
cp "$out/o/final.obj" "$2"
