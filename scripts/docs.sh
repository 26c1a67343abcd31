#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The documentation as a site that can be searched: build/site/index.html. Nothing is written beside the
# sources, and the site asks nothing of any network: open the file, or serve the folder.
#   bash scripts/docs.sh            installs what it needs (setup.sh --docs), builds
#   bash scripts/docs.sh --serve    and serves it at http://127.0.0.1:8000
set -euo pipefail
cd "$(dirname "$0")/.."

serve=no
case ${1:-} in
  '') ;;
  --serve) serve=yes ;;
  *) sed -n '2,5s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
esac
bash scripts/setup.sh --docs
/usr/bin/python3 scripts/site/build.py build/site
echo "docs: build/site/index.html"
if [ "$serve" = yes ]; then
  /usr/bin/python3 -m http.server --bind 127.0.0.1 --directory build/site 8000
fi
