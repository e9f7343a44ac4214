#!/bin/sh
# in-empty-folder.sh FOLDER COMMAND...: runs a command in a folder that is emptied first.
folder=$1
shift
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder" && exec "$@"
