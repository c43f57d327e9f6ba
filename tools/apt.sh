# What tools/setup and tools/peers/fetch share: installing by apt, as root or by sudo. To be sourced, with `set -euo pipefail`.

say() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; }
die() { say "$*"; exit 1; }

as_root() {
    if [ "$(id -u)" -eq 0 ]; then "$@"
    elif command -v sudo >/dev/null; then sudo "$@"
    else die "'$1' needs root: run this as root or install sudo"
    fi
}

# Waits for another apt instead of failing, and never asks a question.
apt_get() {
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3 "$@"
}

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

update_done=no
update_once() {
    [ "$update_done" = yes ] && return
    # A source of another product may be out of reach: that is no reason to stop, a missing package is.
    apt_get update >/dev/null || say "apt-get update reported an error; going on with the lists there are"
    update_done=yes
}

install_packages() {
    local missing=() package
    for package in "$@"; do is_installed "$package" || missing+=("$package"); done
    [ ${#missing[@]} -eq 0 ] && return
    say "installing ${missing[*]}"
    update_once
    apt_get install --no-install-recommends "${missing[@]}" >/dev/null
}

# The mirror this machine takes Debian's main archive from, and the key it is signed with: sets mirror and keyring.
debian_mirror() {
    local found
    found="$(apt-get indextargets --format '$(ORIGIN)|$(LABEL)|$(COMPONENT)|$(IDENTIFIER)|$(REPO_URI)|$(SIGNED_BY)' |
        awk -F'|' '$1 == "Debian" && $2 == "Debian" && $3 == "main" && $4 == "Packages" { print $5 "|" $6; exit }')"
    mirror="${found%%|*}"
    keyring="${found##*|}"
    # apt leaves the field as it is where the source names no key.
    [ -f "$keyring" ] || keyring=/usr/share/keyrings/debian-archive-keyring.gpg
}
