#!/usr/bin/env bash
# merged_shards.sh GOBO DRIVER: shards, some of them without a key, merge to the bytes of the run without shards.
set -euo pipefail
gobo=$(realpath "$1")
driver=$(realpath "$2")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
figures() { "$gobo" "$@" 2> said; }
for keys in "--key point=1" "--key point=1 --key spot=1 --key fog=linear"; do
  for shards in 2 4; do
    for format in csv json; do
      cost=(cost lit --gpu navi21,vega10 --driver "$driver" $keys "--$format")
      figures "${cost[@]}" > alone
      for ((i = 1; i <= shards; ++i)); do figures "${cost[@]}" --shard $i/$shards > $i.shard; done
      "$gobo" merge $(seq -f %g.shard $shards) | cmp - alone
    done
    figures test lit $keys -q --figures alone > said.too
    for ((i = 1; i <= shards; ++i)); do figures test lit $keys -q --figures $i.shard --shard $i/$shards > said.too; done
    "$gobo" merge $(seq -f %g.shard $shards) | cmp - alone
  done
done
