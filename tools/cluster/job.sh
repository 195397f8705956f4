#!/bin/sh
# A task of a Slurm job: runs the line of FILE that the task's number names, the first where there is no array.
#   sbatch [--array=1-N] job.sh FILE
# A shard whose program was killed, as for want of memory, goes back into the queue, up to three times; it goes on where
# it was.
line=$(sed -n "${SLURM_ARRAY_TASK_ID:-1}p" "$1") || exit
[ -n "$line" ] || { echo "job.sh: $1 has no line ${SLURM_ARRAY_TASK_ID:-1}" >&2; exit 2; }
echo "$(date -u +%FT%TZ) $(hostname), start $((${SLURM_RESTART_COUNT:-0} + 1)): $line"
sh -c "$line"
code=$?
echo "exit code $code"
if [ $code -gt 128 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
    # Slurm ends this script when it has taken the job back.
    scontrol requeue "$SLURM_JOB_ID" && sleep 60
fi
# Code 3 is a finding, such as a case that missed its tolerance. Putting the shards together tells it.
[ $code -ne 3 ] || [ -z "$SLURM_ARRAY_TASK_ID" ] || exit 0
exit $code
