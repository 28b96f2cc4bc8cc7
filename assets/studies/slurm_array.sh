#!/usr/bin/env bash
# A study as a Slurm job array: each task does one shard, in a folder of its own, all on a disk that the nodes share.
#   sbatch --array=1-8 slurm_array.sh mine.toml /shared/mine 8
#   nextview study --merge /shared/mine/shard-* --out /shared/mine/all        (once all tasks are done)
# A task that is killed, or whose node fails, is queued again and goes on with what it had done; so does one that is
# submitted again: sbatch --array=3 slurm_array.sh mine.toml /shared/mine 8. `nextview` must be on the PATH of the nodes.
#SBATCH --job-name=nextview-study
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
[ $# -eq 3 ] || { echo "usage: sbatch --array=1-SHARDS $0 STUDY.toml FOLDER SHARDS" >&2; exit 2; }
shard=${SLURM_ARRAY_TASK_ID:?is set in job arrays alone: sbatch --array=1-$3}
mkdir -p "$2"
exec nextview study "$1" --shard "$shard/$3" --resume --out "$2/shard-$shard" --threads "${SLURM_CPUS_PER_TASK:-1}"
