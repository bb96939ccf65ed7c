#!/bin/bash
# Tries gobo on shader sets that others wrote, compares its verdicts with the driver's, and prints a table.
set -u
usage() {
    cat <<END
usage: tools/try_shaders.sh [--gobo GOBO] [--scratch DIR] [--list] [--sanitize POINTS [--contracts FILE]] FOLDER
  FOLDER holds one folder for each set. In a set, every .toml file is a family, tried over its default set.
  Where a set has none, each vertex file with a fragment file of the same name is a pair, for which a family
  of three lines is written: .vs .fs, .vert .frag, .vsh .fsh, .glslv .glslf, _vp.glsl _fp.glsl. Files of that
  name that end in .tcs .tes .gs or .tesc .tese .geom are the stages between, and each subroutine uniform
  becomes a choice of its functions.
  --gobo GOBO      the program to try, with gobo-lab beside it; by default that of build/release
  --scratch DIR    where families, headers, pictures and messages go; by default a new folder of /tmp
  --list           print what is refused, and the reason
  --sanitize POINTS  instead, search each family, and where a set has none each vertex and fragment file, for
                   what GLSL leaves undefined: how many are evaluated, how many refused, how much is found
  --contracts FILE with --sanitize: a second time where something was found, with those domains and constraints
                   of FILE, a line each, whose names the shader reads: how much falls silent, and what is new
The table counts keys: those that gobo takes, whose header it builds, whose interface it prints and whose
picture it draws; then those that the driver was asked about by gobo link, those that gobo takes and the driver
does not link, and those that gobo refuses and the driver links.
END
}
root=$(cd "$(dirname "$0")/.." && pwd)
gobo=$root/build/release/bin/gobo
scratch='' list='' points='' contracts=''
while [ $# -gt 1 ]; do
    case $1 in
        --gobo) gobo=$2; shift 2 ;;
        --scratch) scratch=$2; shift 2 ;;
        --list) list=yes; shift ;;
        --sanitize) points=$2; shift 2 ;;
        --contracts) contracts=$(realpath "$2") || exit 3; shift 2 ;;
        *) usage >&2; exit 2 ;;
    esac
done
if [ $# -ne 1 ] || [ ! -d "$1" ]; then usage >&2; exit 2; fi
folder=$(cd "$1" && pwd)
[ -x "$gobo" ] || { echo "no program $gobo: build it, or name another by --gobo" >&2; exit 3; }
[ -n "$scratch" ] || scratch=$(mktemp -d /tmp/try_shaders.XXXXXX)
mkdir -p "$scratch" || exit 3

# A feature for each subroutine uniform of a shader file: a choice of the functions of its type.
write_subroutines() { # FILE
    local text type name functions
    text=$(sed 's://.*::' "$1" | tr '\n\t\r' '   ')
    grep -oE 'subroutine +uniform +\w+ +\w+' <<< "$text" | while read -r _ _ type name; do
        functions=$(grep -oE "subroutine *\( *$type *\) *\w+ +\w+" <<< "$text" | sed 's/.* /"/; s/$/"/' | paste -sd, -)
        printf '\n[features.%s]\ndefine = "%s"\nvalues = [%s]\n' "$name" "$name" "$functions"
    done
}

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
            { write_subroutines "$vertex"; write_subroutines "$fragment"; } >> "$2/pair_$number.toml"
            dirname "$vertex" > "$2/pair_$number.folder"
        done
    done
}

# Runs gobo and keeps what it says.
run() { # LOG ARGUMENTS...
    local log=$1
    shift
    timeout 900 "$gobo" "$@" > "$log.out" 2> "$log.err"
}
note() {
    [ -n "$list" ] && echo "$*" >&2
}
# The number before some words of the last line of a file; 0 where it is not there.
number_before() { # WORDS FILE
    tail -n 1 "$2" | grep -oE "[0-9]+ $1" | grep -oE '^[0-9]+' || echo 0
}

# The places and messages of what a search found, without the operands.
findings_of() { # ERR_FILE
    grep -E ': error: ' "$1" | sed -E 's/^(.*: error: [^:]*)(:| \().*/\1/' | sort -u
}
# The lines of the contracts that the shader has names for.
write_contracts() { # LOG OUT ARGUMENTS...
    local log=$1 out=$2 unknown
    shift 2
    run "$log.names" sanitize "$@" --points 1 --inputs "$contracts"
    unknown=$(grep -F "$contracts:" "$log.names.err" | grep -oE ':[0-9]+:[0-9]+: error' | cut -d: -f2 | sort -un |
        sed 's/$/d/' | paste -sd';')
    sed "$unknown" "$contracts" > "$out"
}
sanitize_sets() {
    local set name work path log files ran refused found silent new number
    echo '| set | tried | evaluated | refused | findings | silent by contracts | new by contracts |'
    echo '|---|---|---|---|---|---|---|'
    for set in "$folder"/*/; do
        name=$(basename "$set")
        work=$scratch/$name
        mkdir -p "$work"
        mapfile -t files < <(find "$set" -name '*.toml' | sort)
        [ ${#files[@]} -gt 0 ] || mapfile -t files < <(find "$set" -type f | grep -E '\.([vf]s|vert|frag|[vf]sh)$' | sort)
        ran=0 refused=0 found=0 silent=0 new=0 number=0
        for path in "${files[@]}"; do
            number=$((number + 1))
            log=$work/$number
            run "$log.first" sanitize "$path" -I "$(dirname "$path")" --points "$points"
            if ! grep -q ' findings$' "$log.first.out"; then
                refused=$((refused + 1))
                note "$name, $path: $(grep -m 1 error "$log.first.err")"
                continue
            fi
            ran=$((ran + 1))
            findings_of "$log.first.err" > "$log.found"
            found=$((found + $(wc -l < "$log.found")))
            { [ -n "$contracts" ] && [ -s "$log.found" ]; } || continue
            write_contracts "$log" "$log.toml" "$path" -I "$(dirname "$path")"
            run "$log.second" sanitize "$path" -I "$(dirname "$path")" --points "$points" --inputs "$log.toml"
            findings_of "$log.second.err" > "$log.left"
            silent=$((silent + $(comm -23 "$log.found" "$log.left" | wc -l)))
            new=$((new + $(comm -13 "$log.found" "$log.left" | wc -l)))
        done
        echo "| $name | ${#files[@]} | $ran | $refused | $found | $silent | $new |"
    done
}
if [ -n "$points" ]; then
    sanitize_sets
    echo "messages: $scratch" >&2
    exit
fi

echo '| set | families | keys | taken | built | reflected | drawn | compared | taken, not linked | refused, linked |'
echo '|---|---|---|---|---|---|---|---|---|---|'
for set in "$folder"/*/; do
    name=$(basename "$set")
    work=$scratch/$name
    mkdir -p "$work"
    mapfile -t families < <(find "$set" -name '*.toml' | sort)
    if [ ${#families[@]} -eq 0 ]; then
        write_pairs "$set" "$work"
        mapfile -t families < <(find "$work" -maxdepth 1 -name '*.toml' | sort -V)
    fi
    keys=0 taken=0 built=0 reflected=0 drawn=0 compared=0 laxer=0 stricter=0 number=0
    for family in "${families[@]}"; do
        number=$((number + 1))
        log=$work/$number
        of=$(cat "${family%.toml}.folder" 2> /dev/null || dirname "$family")
        # A family that cannot be listed counts as one key that fails.
        run "$log.list" list "$family" || echo default > "$log.list.out"
        count=$(wc -l < "$log.list.out")
        keys=$((keys + count))
        run "$log.link" link "$family" -I "$of"
        grep -q compared "$log.link.out" || note "$name, $family: $(grep -m 1 error "$log.link.err")"
        grep 'refused, though' "$log.link.out" | while read -r line; do note "$name, $family, $line"; done
        grep 'error: gobo takes' "$log.link.err" | while read -r line; do note "$name, $family, $line"; done
        more=$(number_before 'taken that the driver' "$log.link.out")
        taken=$((taken + more + $(number_before 'taken and linked' "$log.link.out")))
        laxer=$((laxer + more))
        stricter=$((stricter + $(number_before 'refused that it' "$log.link.out")))
        compared=$((compared + $(number_before 'compared' "$log.link.out")))
        run "$log.build" build "$family" -I "$of" -o "$work/headers_$number" && built=$((built + count))
        while read -r key; do
            run "$log.reflect" reflect "$family" "$key" -I "$of" && reflected=$((reflected + 1))
        done < "$log.list.out"
        run "$log.render" render "$family" -I "$of" --keys-from "$log.list.out" -o "$work/pictures_$number" --size 16x12 ||
            note "$name, $family: $(grep -m 1 error "$log.render.err")"
        drawn=$((drawn + $(wc -l < "$log.render.out")))
    done
    echo "| $name | ${#families[@]} | $keys | $taken | $built | $reflected | $drawn | $compared | $laxer | $stricter |"
done
echo "messages and pictures: $scratch" >&2
