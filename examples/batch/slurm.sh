#!/bin/sh
# A plan as a Slurm array of 50 shards; each job makes its items in as many processes as it has cores.
#     PLAN=plan.toml OUT=/shared/leaves sbatch examples/batch/slurm.sh
# Safe to submit again: what is whole is not made again. The job that makes the last item writes the manifest.
#SBATCH --job-name=wilt
#SBATCH --array=1-50
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=32
#SBATCH --time=12:00:00
#SBATCH --requeue
#SBATCH --signal=INT@60
exec srun wilt batch "${PLAN:?}" -o "${OUT:?}" \
  --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --jobs "$SLURM_CPUS_PER_TASK"
