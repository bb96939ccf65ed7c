#!/usr/bin/env bash
# list_of_chips.sh GOBO DRIVER: chips of which the driver is of no use, as it aborts, has no device or tells nothing of what it compiles, are
# listed as known to nobody; those for which it is there and does not compile, with the reason.
set -euo pipefail
"$1" cost --gpu list --driver "$2" 2> /dev/null | sed -n '1,7p;/^polaris10/p' | diff - <(cat <<'END'
GPU        architecture  such as            known to
tahiti     GCN1          Radeon HD 7970     -
pitcairn   GCN1          Radeon HD 7870     -
bonaire    GCN2          Radeon HD 7790     -
hawaii     GCN2          Radeon R9 290      -
tonga      GCN3          Radeon R9 285      no use: fake 1.0 answered vkCreateShaderModule with -2
fiji       GCN3          Radeon R9 Fury     no use: fake 1.0 crashed with signal 6 (Aborted)
polaris10  GCN4          Radeon RX 480      fake 1.0
END
)
