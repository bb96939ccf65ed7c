#!/usr/bin/env bash
# shards.sh GOBO folder|redis: shards that share a cache, one of them killed half-way and started again, leave the run without shards nothing to do,
# and it prints what a run without a cache does. In Redis where one can be started.
set -euo pipefail
gobo=$1
unset GOBO_CACHE_DIR
work=$(mktemp -d)
cd "$work"
redis=
trap '[ -z "$redis" ] || kill "$redis" 2>/dev/null || true; wait; rm -rf "$work"' EXIT

if [ "$2" = redis ]; then
  command -v redis-server >/dev/null || { echo "skipped: no redis-server; tools/setup.sh installs it where it can"; exit 77; }
  port=$((20000 + $$ % 20000))
  redis-server --port $port --bind 127.0.0.1 --save '' --appendonly no --dir "$work" >redis.log &
  redis=$!
  cache=redis://127.0.0.1:$port
  for ((i = 0; i < 200; ++i)); do redis-cli -p $port ping >pong 2>&1 && break; sleep 0.05; done
  "$gobo" check lit --key default -q --cache "$cache" 2>&1 | grep -q 'built without hiredis' && { echo "skipped: gobo was built without hiredis"; exit 77; }
  redis-cli -p $port flushall >pong
  count() { redis-cli -p $port dbsize; }
  damage() { for key in $(redis-cli -p $port --scan --pattern 'gobo:*'); do redis-cli -p $port setrange "$key" 20 damaged >pong; done; }
else
  cache=$work/kept
  count() { find "$cache" -name '*.result' 2>/dev/null | wc -l; }
  damage() { for file in "$cache"/*/*.result; do printf damaged | dd of="$file" bs=1 seek=20 conv=notrunc status=none; done; }
fi

# one NAME ARGUMENTS...: standard output, messages and exit status of gobo in a file.
one() {
  local name=$1 status=0
  shift
  "$gobo" "$@" -j 2 >"$name" 2>"$name.messages" || status=$?
  sed -E 's/ \([0-9]+ stages? compiled\)//' "$name.messages" >>"$name"
  echo "exit $status" >>"$name"
}

cat >divides.frag <<'END'
#version 450
layout(location = 0) in float near;
layout(location = 0) out vec4 color;
void main() { color = vec4(1.0 / near); }
END
cat >divides.toml <<'END'
name     = "divides"
vertex   = "divides.vert"
fragment = "divides.frag"
[features]
fog = { values = ["none", "linear", "squared"] }
END
cat >divides.vert <<'END'
#version 450
layout(location = 0) in vec4 position;
layout(location = 0) out float near;
void main() { near = position.x; gl_Position = position; }
END
sed -i 's|^void main() { color|#include <fog>\nvoid main() { color|; s|1.0 / near|seen(1.0 / near)|' divides.frag
mkdir fog
echo 'float seen(float x) { return x; }' >fog/none.glsl
echo 'float seen(float x) { return 1.0 / x; }' >fog/linear.glsl
echo 'float seen(float x) { return sqrt(x); }' >fog/squared.glsl

for command in "check lit --cover 1" "sanitize lit --cover 1 --points 512" "sanitize divides.toml --all" "prove lit --cover 1" "prove divides.toml --all"; do
  one alone $command
  one first $command --shard 1/2 --cache "$cache"
  before=$(count)
  "$gobo" $command --shard 2/2 -j 1 --cache "$cache" >killed 2>&1 &
  worker=$!
  for ((i = 0; i < 2000; ++i)); do [ "$(count)" -gt $((before + 1)) ] && break; kill -0 $worker 2>/dev/null || break; sleep 0.005; done
  kill -9 $worker 2>/dev/null || true
  wait $worker 2>/dev/null || true
  one second $command --shard 2/2 --cache "$cache"
  kept=$(count)
  one joined $command --cache "$cache"
  cmp alone joined || { diff alone joined; exit 1; }
  # The answer to a whole command is kept, too.
  new=$(($(count) - kept))
  [ $new -le 1 ] || { echo "$command: $new results were not found"; exit 1; }
  echo "ok $command: $kept results"
done

damage
one joined check lit --cover 1 --cache "$cache"
one alone check lit --cover 1
cmp alone joined
echo "ok damaged results count for none"
if [ -n "$redis" ]; then
  kill "$redis"
  wait "$redis" || true
  redis=
  one joined check lit --cover 1 --cache "$cache"
  grep -q "warning: the cache $cache does not answer" joined && tail -n 1 joined | grep -qx 'exit 0'
  echo "ok without Redis there is a warning"
fi
