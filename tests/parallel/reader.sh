#!/usr/bin/env bash
# Somebody who holds the results open, as h5py and ParaView do, neither stops the job nor changes what it writes.
source "$(dirname "$0")/rolling.sh"

cp -r "$tyre/static" "$folder/watched"
/usr/bin/python3 -c "import h5py, sys, time; f = h5py.File(sys.argv[1]); print('open', flush=True); time.sleep(180)" \
  "$folder/watched/small_tyre.h5" >"$folder/reader.out" &
reader=$!
trap 'kill "$reader" 2>/dev/null || true' EXIT
until grep -q open "$folder/reader.out"; do kill -0 "$reader"; sleep 0.05; done
run_on 2 "$folder/watched" --restart
same_results "$folder/watched"
