#!/bin/bash
# Draws sample models that others publish, compares each with the oracle's picture, and writes a page and a table.
set -u
usage() {
    cat <<END
usage: tools/try_models.sh [--gobo GOBO] [--compare PROGRAM] [--scratch DIR] FOLDER
  FOLDER holds the models, in whatever folders: those that tests/scenes/sample_models.tsv names are looked for.
  --gobo GOBO         the program to try, with gobo-lab beside it; by default that of build/release
  --compare PROGRAM   tests/scenes/compare_models (cmake --build --preset release --target compare_models)
  --scratch DIR       where pictures and the page go; by default a new folder of /tmp
The page DIR/index.html has gobo's picture of each, the same drawn small, the oracle's, and beside them what the
model's author says that it shows. The table counts the pixels within draws, and of them those that are more than
4 of 255 steps of sRGB away from the oracle's; then the mean difference in steps, and what is not drawn.
END
}
root=$(cd "$(dirname "$0")/.." && pwd)
gobo=$root/build/release/bin/gobo
compare=$root/build/release/tests/scenes/compare_models
scratch=''
while [ $# -gt 1 ]; do
    case $1 in
        --gobo) gobo=$2; shift 2 ;;
        --compare) compare=$2; shift 2 ;;
        --scratch) scratch=$2; shift 2 ;;
        *) usage >&2; exit 2 ;;
    esac
done
if [ $# -ne 1 ] || [ ! -d "$1" ]; then usage >&2; exit 2; fi
folder=$(cd "$1" && pwd)
for program in "$gobo" "$compare"; do
    [ -x "$program" ] || { echo "no program $program: build it, or name another" >&2; exit 3; }
done
[ -n "$scratch" ] || scratch=$(mktemp -d /tmp/try_models.XXXXXX)
mkdir -p "$scratch" || exit 3

escaped() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }
# What the author writes of the model, where a README lies beside it or a folder above.
author_text() { # FILE
    local at
    for at in "$(dirname "$1")" "$(dirname "$1")/.."; do
        [ -f "$at/README.md" ] && { head -c 4000 "$at/README.md" | escaped; return; }
    done
}

page=$scratch/index.html
cat > "$page" <<'END'
<!doctype html><meta charset="utf-8"><title>Sample models</title>
<style>body{font-family:sans-serif;margin:2em}td{vertical-align:top;padding:.5em;border-top:1px solid #ccc}pre{white-space:pre-wrap;max-height:16em;overflow:auto;font-size:80%}</style>
<table><tr><th>by gobo<th>small: by OpenGL, by the oracle<th>what it shows
END
echo '| model | of | pixels | differ | mean | not drawn |'
echo '|---|---|---|---|---|---|'
number=0 found=0 alike=0
while IFS=$'\t' read -r path by shows otherwise; do
    case $path in ''|'#'*) continue ;; esac
    number=$((number + 1))
    file=$(find "$folder" -path "*/$path" | sort | head -n 1)
    name=${path##*/}
    [ -n "$file" ] || { echo "not found: $path" >&2; continue; }
    found=$((found + 1))
    own=$scratch/$number
    mkdir -p "$own"
    timeout 300 "$gobo" render pbr --scene "$file" -o "$own" --size 400x300 --smooth 2 > "$own/drawn" 2> "$own/said" ||
        echo "$path: $(head -n 1 "$own/said")" >&2
    line=$(timeout 600 "$compare" "$own" 160x120 "$file" 2>> "$own/said") || { echo "$path: not compared" >&2; continue; }
    IFS=$'\t' read -r _ pixels differ mean asked largest <<< "$line"
    missing=$(sed -n 's/.*: not drawn: //p' "$own/said" | head -n 1)
    # One pixel in a hundred may be where levels of pictures are chosen otherwise.
    [ $((differ * 100)) -le "$pixels" ] && alike=$((alike + 1))
    echo "| \`$name\` | $by | $pixels | $differ | $mean | $missing |"
    cat >> "$page" <<END
<tr><td><img src="$number/$(basename "$(head -n 1 "$own/drawn")")"><td><img src="$number/0.drawn.png"><br><img src="$number/0.oracle.png">
<p>$differ of $pixels pixels differ; on the mean by $mean of 255 steps; asked at $asked fragments, the stage is within $largest.
<td><b>$name</b> ($by)<p>$(escaped <<< "$shows")<p><i>$(escaped <<< "$otherwise")</i><p>$(escaped <<< "$missing")<pre>$(author_text "$file")</pre>
END
done < "$root/tests/scenes/sample_models.tsv"
echo "</table>" >> "$page"
echo "$found of $number models found; $alike are the oracle's picture but for one pixel in a hundred: $page" >&2
