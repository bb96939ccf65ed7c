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

# What is cut or changed is no shard, and figures of two drivers are of no run.
refused() { if "$gobo" merge "$@" > said 2>&1; then echo "gobo merge $*: taken"; exit 1; fi; }
cp "$driver" driver.so
cost=(cost lit --gpu navi21,vega10 --driver ./driver.so --key point=1 --key spot=1 --csv)
for i in 1 2; do figures "${cost[@]}" --shard $i/2 > $i.shard; done
for ((bytes = 0; bytes < $(stat -c %s 2.shard); bytes += 97)); do head -c $bytes 2.shard > cut; refused 1.shard cut; done
sed 2d 2.shard > row; refused 1.shard row
sed 2p 2.shard > row; refused 1.shard row
sed -i 's/1\.0/9.9/' driver.so
figures "${cost[@]}" --shard 2/2 > 2.shard
refused 1.shard 2.shard
grep "has figures of gpu 'navi21', driver" said
