#!/usr/bin/env bash
# What becomes of outputs and exit statuses when things go wrong: gobo is killed, runs twice at once, and meets full disks, closed
# streams and files in the way. Prints a table, one row a kind: how often it was tried, and how often it was not as it should be.
# usage: tools/torture.sh [--short] [GOBO]
set -uo pipefail
kills=200 races=100
[ "${1:-}" != --short ] || { kills=10 races=5; shift; }
gobo=$(realpath "${1:-build/release/bin/gobo}")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
chmod 755 "$scratch"
cd "$scratch"

# A family of two texts: the header, the manifest and the depfile of one differ from those of the other.
family() {  # family FOLDER NUMBER
  mkdir -p "$1/pattern"
  printf 'name = "torn"\nvertex = "torn.vert"\nfragment = "torn.frag"\n[features.pattern]\nvalues = ["plain", "v%s"]\n' "$2" >"$1/torn.toml"
  printf '#version 450\nvoid main() { gl_Position = vec4(%s.0); }\n' "$2" >"$1/torn.vert"
  printf '#version 450\n#include <pattern>\nlayout(location = 0) out vec4 color;\nvoid main() { color = pattern(); }\n' >"$1/torn.frag"
  printf 'vec4 pattern() { return vec4(0.0); }\n' >"$1/pattern/plain.glsl"
  printf 'vec4 pattern() { return vec4(%s.0); }\n' "$2" >"$1/pattern/v$2.glsl"
}
expect() {  # expect OPTIONS...: what the builds of both families give
  local n
  for n in 1 2; do (cd "family$n" && rm -rf out "../expected$n" && "$gobo" build torn.toml --all "$@" -o out --quiet && mv out "../expected$n") || exit 1; done
}
for n in 1 2; do family "family$n" "$n"; done
expect
mkdir work && cp -r family1/. work

# The family is now that of the number, its outputs those of the other one.
prepare() {  # prepare NUMBER
  rm -rf work/out work/pattern
  cp -r "family$1/." work
  cp -r "expected$((3 - $1))" work/out
}
files='torn.d torn.hpp torn.json' split=
# Each file is one of the two whole ones; where the header is the new one, all are.
whole() {  # whole NUMBER
  local file old="expected$((3 - $1))"
  for file in $files; do
    cmp -s "work/out/$file" "expected$1/$file" && continue
    cmp -s "work/out/$file" "$old/$file" && cmp -s work/out/torn.hpp "$old/torn.hpp" || return 1
  done
}
only_outputs() { [ "$(ls -A work/out | tr '\n' ' ')" = "$files " ]; }
new_outputs() {  # new_outputs NUMBER
  local file
  only_outputs || return 1
  for file in $files; do cmp -s "work/out/$file" "expected$1/$file" || return 1; done
}
old_outputs() { new_outputs $((3 - $1)); }
start() { cd work && exec "$gobo" build torn.toml --all $split -o out --quiet 2>../messages; }
build() { (start); }

failed=0
row() {  # row WHAT TRIED WRONG
  printf '%-66s %6s %6s\n' "$1" "$2" "$3"
  [ "$3" = 0 ] || [ "$3" = - ] || failed=1
}
# one WHAT COMMAND...: tried once.
one() {
  local what=$1 wrong=0
  shift
  "$@" || wrong=1
  row "$what" 1 $wrong
}
skipped() { row "$1" - -; }
# exits STATUS COMMAND...: whether it ends with that status within 20 seconds, as no signal would have it.
exits() {
  local wanted=$1 status=0
  shift
  timeout 20 "$@" >output 2>messages || status=$?
  [ $status -eq "$wanted" ]
}
printf '%-66s %6s %6s\n' 'what happens' tried wrong

# Killed.
prepare 1
begin=$(date +%s%N); build; took=$((($(date +%s%N) - begin) / 1000))
kill_at_random() {  # sets wrong
  local i number
  wrong=0
  for ((i = 0; i < kills; ++i)); do
    number=$((1 + i % 2))
    prepare $number
    start & process=$!
    sleep "$(awk -v t=$took -v r=$RANDOM 'BEGIN { printf "%.6f", t * 1.1 * r / 32768 / 1e6 }')"
    kill -9 $process 2>/dev/null
    wait $process 2>/dev/null
    whole $number && build && new_outputs $number || wrong=$((wrong + 1))
  done
}
kill_at_random
row 'killed at a random moment; what the next build leaves' $kills $wrong
files='torn.cpp torn.d torn.hpp torn.json' split=--split
expect --split
kill_at_random
row 'the same with --split' $kills $wrong
files='torn.d torn.hpp torn.json' split=
expect
what='killed at each call that opens, writes or renames a file'
if strace -f -o trace true 2>/dev/null; then
  wrong=0 tried=0
  calls=openat,write,flock,rename,unlink,close
  prepare 1
  (cd work && strace -f -e trace=$calls -o ../trace "$gobo" build torn.toml --all -o out --quiet)
  first=$(awk '/gobo-new/ && !n { print NR - 1; n = 1 }' trace)
  last=$(grep -c . trace)
  for ((at = first; at <= last; ++at)); do
    call=$(sed -n "${at}s/^[0-9]* *\([a-z0-9_]*\)(.*/\1/p" trace)
    [ -n "$call" ] || continue
    when=$(sed -n "1,${at}p" trace | grep -c " $call(")
    prepare 1
    (cd work && strace -f -o ../killed -e trace=none -e inject=$call:signal=KILL:when=$when "$gobo" build torn.toml --all -o out --quiet) >/dev/null 2>&1
    tried=$((tried + 1))
    whole 1 && build && new_outputs 1 || wrong=$((wrong + 1))
  done
  [ $tried -gt 10 ] || wrong=$((wrong + 1))
  row "$what" $tried $wrong
else
  skipped "$what"
fi

# Twice at once.
wrong=0
for ((i = 0; i < races; ++i)); do
  number=$((1 + i % 2))
  prepare $number
  build & first=$!
  build & second=$!
  wait $first && wait $second && new_outputs $number || wrong=$((wrong + 1))
done
row 'two builds of the same at once' $races $wrong
wrong=0
for ((i = 0; i < races; ++i)); do
  prepare 1
  (cd family1 && "$gobo" build torn.toml --all -o "$scratch/work/out" --depfile-target out/torn.hpp --quiet 2>/dev/null) & first=$!
  (cd family2 && "$gobo" build torn.toml --all -o "$scratch/work/out" --depfile-target out/torn.hpp --quiet 2>/dev/null) & second=$!
  wait $first && wait $second && { new_outputs 1 || new_outputs 2; } || wrong=$((wrong + 1))
done
row 'two builds of different texts into one folder' $races $wrong
wrong=0
prepare 1
(while [ ! -e still ]; do mv work/pattern/plain.glsl away; mv away work/pattern/plain.glsl; done) 2>/dev/null & mover=$!
for ((i = 0; i < races; ++i)); do
  build
  status=$?
  [ $status -le 1 ] || [ $status -eq 3 ] || wrong=$((wrong + 1))
done
touch still; wait $mover
build && new_outputs 1 || wrong=$((wrong + 1))
row 'a piece that vanishes and comes back while builds run' $races $wrong

# Disks.
refused() { prepare 1; "$@"; [ $? -eq 3 ] && old_outputs 1; }
limited() { (ulimit -f 1; build); }
one 'ulimit -f: old outputs, status 3' refused limited
what='a full disk: old outputs, status 3'
full_disk() {
  prepare 1
  unshare -m bash -c 'mount -t tmpfs -o size=64k none work/out || exit 1
    cp expected2/torn.* work/out; head -c 65536 /dev/zero >work/out/full 2>/dev/null
    (cd work && "$0" build torn.toml --all -o out --quiet 2>../messages); status=$?
    for file in torn.d torn.hpp torn.json; do cmp -s "work/out/$file" "expected2/$file" || exit 1; done
    [ $status -eq 3 ] && [ "$(ls -A work/out | wc -l)" -eq 4 ]' "$gobo"
}
if unshare -m bash -c 'mount -t tmpfs -o size=64k none work/out' 2>/dev/null; then one "$what" full_disk; else skipped "$what"; fi
one 'standard output on a full disk: status 3' exits 3 sh -c '"$0" list lit >/dev/full' "$gobo"
one '--help on a full disk: status 3' exits 3 sh -c '"$0" --help >/dev/full' "$gobo"

# In the way.
in_the_way() {  # in_the_way FILE
  prepare 1; rm "work/out/$1"; mkdir "work/out/$1"; build; [ $? -eq 3 ] || return 1
  rmdir "work/out/$1"; cp "expected2/$1" work/out; old_outputs 1
}
for file in $files; do one "a folder where $file goes: old outputs, status 3" in_the_way $file; done
left_behind() { prepare 1; for file in $files; do echo half >"work/out/$file.gobo-new"; done; build && new_outputs 1; }
one 'temporary files of a build that died: new outputs, nothing left' left_behind
unchanged() { left_behind; for file in $files; do echo half >"work/out/$file.gobo-new"; done; build && new_outputs 1; }
one 'the same where nothing changes' unchanged
link_in_the_way() {
  prepare 1
  echo mine >victim; chmod 644 victim
  for file in $files; do ln -sf ../../victim "work/out/$file"; ln -s ../../victim "work/out/$file.gobo-new"; done
  build; [ "$(cat victim)" = mine ] || return 1
  rm work/out/*.gobo-new; build && new_outputs 1
}
one 'links to a file of others: it stays as it is' link_in_the_way
dangling() { prepare 1; rm -r work/out; ln -s nowhere work/out; build; [ $? -eq 3 ] && rm work/out; }
one 'an output folder that is a link to nowhere: status 3' dangling
file_as_folder() { prepare 1; rm -r work/out; echo x >work/out; build; [ $? -eq 3 ] && [ "$(cat work/out)" = x ] && rm work/out; }
one 'a file where the output folder goes: status 3' file_as_folder
what='as nobody, in a folder that cannot be written: old outputs, status 3'
as_nobody() { (cd work && setpriv --reuid=65534 --regid=65534 --clear-groups "$@" 2>../messages); }
read_only() { as_nobody "$gobo" build torn.toml --all -o out --quiet; }
may_read() { prepare 1; chmod -R a+rX .; as_nobody "$gobo" list torn.toml >/dev/null; }
if may_read; then
  one "$what" refused read_only
  closed_folder() { prepare 1; mkdir work/mine; chmod -R a+rX .; chmod 0 work/mine; as_nobody "$gobo" check torn.toml --all -I mine; [ $? -eq 3 ]; }
  one 'as nobody, a folder of -I that may not be entered: status 3' closed_folder
  one 'as nobody, without HOME and TMPDIR' eval 'as_nobody env -i "$gobo" list lit >/dev/null'
else
  skipped "$what"
fi

# Streams, pipes, limits, the environment.
one 'standard output closed: status 3' exits 3 sh -c '"$0" list lit >&-' "$gobo"
one 'all streams closed: outputs all the same' eval 'prepare 1; build <&- >&- && new_outputs 1'
one 'a pipe whose reader is gone: status 3, no signal' eval '{ sleep 0.2; "$gobo" list lit --cover 2 2>/dev/null; echo $? >status; } | true; [ "$(cat status)" = 3 ]'
mkfifo pipe.toml
one 'a pipe that nobody writes to as a family: status 3' exits 3 "$gobo" list pipe.toml
one 'a folder as a family: status 3' exits 3 "$gobo" list family1/torn.toml/../pattern/../../work.toml
mkdir folder.toml
one 'a folder named as a family: status 3' exits 3 "$gobo" list folder.toml
one 'a device that never ends as keys: status 3' exits 3 "$gobo" list lit --keys-from /dev/zero
what='little memory (ulimit -v): new outputs, or old ones and status 3'
if (ulimit -v 4000000; "$gobo" --version >/dev/null 2>&1); then  # AddressSanitizer wants more than there is
  wrong=0 tried=0
  for memory in 20000 40000 60000 80000 100000 150000 200000; do
    prepare 1
    (ulimit -v $memory; build)
    status=$?
    tried=$((tried + 1))
    [ $status -eq 0 ] && new_outputs 1 || { [ $status -eq 3 ] || [ $status -eq 127 ] && old_outputs 1; } || wrong=$((wrong + 1))
  done
  row "$what" $tried $wrong
else
  skipped "$what"
fi
wrong=0 tried=0
for stack in 64 256 1024 unlimited; do
  prepare 1
  tried=$((tried + 1))
  (ulimit -s $stack; build) && new_outputs 1 || wrong=$((wrong + 1))
done
row 'little stack, and stack without end (ulimit -s): new outputs' $tried $wrong
(cd work && "$gobo" list lit --cover 2 >../expected_keys)
wrong=0 tried=0
for locale in C POSIX C.UTF-8 de_DE.UTF-8 tr_TR.ISO-8859-9 no_such '' /; do
  tried=$((tried + 1))
  LC_ALL=$locale LANG=$locale "$gobo" list lit --cover 2 2>/dev/null | cmp -s - expected_keys || wrong=$((wrong + 1))
done
row 'odd locales: the same bytes' $tried $wrong
one 'an empty environment: the same bytes' eval 'env -i "$gobo" list lit --cover 2 | cmp -s - expected_keys'
mkdir gone
one 'a current folder that is gone' eval '(cd gone && rmdir ../gone && "$gobo" list lit --cover 2) | cmp -s - expected_keys'
exit $failed
