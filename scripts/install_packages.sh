# Sourced by the other scripts: install_packages NAME... installs the Debian packages that are
# missing, with sudo if need be. Packages that are there already need neither root nor a network.
install_packages()
{
  local package missing=() run=()
  for package in "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' \
      || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo > /dev/null; then
      echo "Please install: ${missing[*]}" >&2
      return 1
    fi
    run=(sudo)
  fi
  echo "Installing: ${missing[*]}"
  "${run[@]}" apt-get -q update
  "${run[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -q -y install --no-install-recommends "${missing[@]}"
}
