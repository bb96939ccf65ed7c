#!/bin/bash
# Tries gobo on shader sets that others wrote, and prints a table of how far each comes.
set -u
usage() {
    cat <<END
usage: tools/try_shaders.sh [--gobo GOBO] [--link PROGRAM] [--scratch DIR] [--list] FOLDER
  FOLDER holds one folder for each set. In a set, every .toml file is a family, tried over its default set.
  Where a set has none, each vertex file with a fragment file of the same name is a pair, for which a family
  of three lines is written: .vs .fs, .vert .frag, .vsh .fsh, .glslv .glslf, _vp.glsl _fp.glsl. Files of that
  name that end in .tcs .tes .gs or .tesc .tese .geom are the stages between.
  --gobo GOBO      the program to try; by default that of build/release
  --link PROGRAM   asks the driver about texts that gobo refuses: reads lines "ID core|es VERTEX FRAGMENT"
                   and answers "ID linked" or "ID refused", a tab between them
  --scratch DIR    where families, headers, pictures and messages go; by default a new folder of /tmp
  --list           print each refused key with the first error
END
}
root=$(cd "$(dirname "$0")/.." && pwd)
gobo=$root/build/release/bin/gobo
link='' scratch='' list=''
while [ $# -gt 1 ]; do
    case $1 in
        --gobo) gobo=$2; shift 2 ;;
        --link) link=$2; shift 2 ;;
        --scratch) scratch=$2; shift 2 ;;
        --list) list=yes; shift ;;
        *) usage >&2; exit 2 ;;
    esac
done
if [ $# -ne 1 ] || [ ! -d "$1" ]; then usage >&2; exit 2; fi
folder=$(cd "$1" && pwd)
[ -x "$gobo" ] || { echo "no program $gobo: build it, or name another by --gobo" >&2; exit 3; }
[ -n "$scratch" ] || scratch=$(mktemp -d /tmp/try_shaders.XXXXXX)
mkdir -p "$scratch" || exit 3

# A family file for each vertex file of a set that has a fragment file of the same name.
write_pairs() { # SET_FOLDER DIR
    local vertex fragment number=0 ends stage ends_with other
    find "$1" -type f | sort | while read -r vertex; do
        for ends in '.vs .fs' '.vert .frag' '.vsh .fsh' '.glslv .glslf' '_vp.glsl _fp.glsl'; do
            fragment=${vertex%"${ends% *}"}${ends#* }
            { [ "$fragment" != "$vertex${ends#* }" ] && [ -f "$fragment" ]; } || continue
            number=$((number + 1))
            cat > "$2/pair_$number.toml" <<END
name     = "pair_$number"
vertex   = "$(basename "$vertex")"
fragment = "$(basename "$fragment")"
END
            while read -r stage ends_with; do
                other=$(basename "${vertex%"${ends% *}"}$ends_with")
                [ -f "$(dirname "$vertex")/$other" ] && echo "$stage = \"$other\"" >> "$2/pair_$number.toml"
            done <<END
tess_control .tcs
tess_control .tesc
tess_evaluation .tes
tess_evaluation .tese
geometry .gs
geometry .geom
END
            dirname "$vertex" > "$2/pair_$number.folder"
        done
    done
}

# Runs gobo, keeps what it says, adds 1 to the count named first where it succeeds.
try() { # COUNT LOG ARGUMENTS...
    local count=$1 log=$2
    shift 2
    timeout 300 "$gobo" "$@" > "$log.out" 2> "$log.err" || return 1
    printf -v "$count" %d $((${!count} + 1))
}

# Whether the driver links a key's text: yes, no, or ? without --link.
driver_links() { # FAMILY FOLDER KEY LOG
    local context=core
    [ -n "$link" ] || { echo '?'; return; }
    grep -E '^(tess|geometry|compute)' "$1" > /dev/null && { echo '?'; return; }  # it links pairs
    "$gobo" show "$1" "$3" -I "$2" --stage vertex > "$4.vert" 2> /dev/null || { echo '?'; return; }
    "$gobo" show "$1" "$3" -I "$2" --stage fragment > "$4.frag" 2> /dev/null || { echo '?'; return; }
    head -n 1 "$4.vert" | grep ' es' >/dev/null && context=es
    echo "x $context $4.vert $4.frag" | "$link" | grep '^x	linked' >/dev/null && echo yes || echo no
}

echo '| set | families | keys | check | build | reflect | render, linked by the driver | refused though the driver links |'
echo '|---|---|---|---|---|---|---|---|'
for set in "$folder"/*/; do
    name=$(basename "$set")
    work=$scratch/$name
    mkdir -p "$work"
    mapfile -t families < <(find "$set" -name '*.toml' | sort)
    if [ ${#families[@]} -eq 0 ]; then
        write_pairs "$set" "$work"
        mapfile -t families < <(find "$work" -maxdepth 1 -name '*.toml' | sort -V)
    fi
    keys=0 check=0 build=0 reflect=0 render=0 stricter=0 number=0
    for family in "${families[@]}"; do
        number=$((number + 1))
        log=$work/$number
        of=$(cat "${family%.toml}.folder" 2> /dev/null || dirname "$family")
        # Keys first: a family that cannot be listed counts as one key that fails.
        "$gobo" list "$family" > "$log.keys" 2> "$log.list.err" || echo default > "$log.keys"
        try build "$log.build" build "$family" -I "$of" -o "$work/headers_$number"
        row=0
        while read -r key; do
            row=$((row + 1))
            keys=$((keys + 1))
            at=$log.$row
            if ! try check "$at.check" check "$family" -I "$of" --key "$key"; then
                linked=$(driver_links "$family" "$of" "$key" "$at")
                [ "$linked" = yes ] && stricter=$((stricter + 1))
                [ -n "$list" ] && echo "$name, $family, $key (driver links: $linked): $(grep -m 1 error "$at.check.err")" >&2
                continue
            fi
            try reflect "$at.reflect" reflect "$family" "$key" -I "$of"
            if ! try render "$at.render" render "$family" -I "$of" --key "$key" -o "$work/pictures_$number" --size 16x12; then
                [ -n "$list" ] && echo "$name, $family, $key: $(grep -m 1 error "$at.render.err")" >&2
            fi
        done < "$log.keys"
    done
    [ -n "$link" ] || stricter='?'
    echo "| $name | ${#families[@]} | $keys | $check | $build | $reflect | $render | $stricter |"
done
echo "messages and pictures: $scratch" >&2
