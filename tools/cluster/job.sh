#!/bin/sh
# A task of a Slurm job: runs the line of FILE with the task's number, the first line without an array.
#   sbatch [--array=1-N] job.sh FILE
# A shard whose program was killed, such as for lack of memory, is requeued up to three times and resumes.
line=$(sed -n "${SLURM_ARRAY_TASK_ID:-1}p" "$1") || exit
[ -n "$line" ] || { echo "job.sh: $1 has no line ${SLURM_ARRAY_TASK_ID:-1}" >&2; exit 2; }
echo "$(date -u +%FT%TZ) $(hostname), start $((${SLURM_RESTART_COUNT:-0} + 1)): $line"
sh -c "$line"
code=$?
echo "exit code $code"
if [ $code -gt 128 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
    # Slurm ends this script once the job is requeued.
    scontrol requeue "$SLURM_JOB_ID" && sleep 60
fi
# Code 3 is a finding, such as a case that missed its tolerance. Merging the shards reports it.
[ $code -ne 3 ] || [ -z "$SLURM_ARRAY_TASK_ID" ] || exit 0
exit $code
