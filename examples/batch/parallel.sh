#!/bin/sh
# A plan on several machines with GNU parallel, a shard each, by ssh: examples/batch/parallel.sh PLAN DIR MACHINE...
# PLAN and DIR are seen by all machines under the same absolute names, wilt is on their PATH.
set -eu
plan=$(realpath "$1") folder=$(realpath -m "$2")
shift 2
machines=$(printf '%s,' "$@")
seq $# | parallel --sshlogin "${machines%,}" --jobs 1 --halt never --retries 3 --line-buffer --tagstring 'shard {}' \
  wilt batch "$plan" -o "$folder" --shard "{}/$#" -q
# Whoever came last may have missed what another was still making.
exec wilt batch "$plan" -o "$folder"
