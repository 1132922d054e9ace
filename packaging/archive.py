"""The program with what belongs to it, to be unpacked anywhere: on Linux with its manual page and completions."""
from release import LINUX, ROOT, WINDOWS, write_tar_gz, write_zip
from texts import texts


def make_tar(release):
    linux = release.built[LINUX]
    name = f"feedhold-{release.version}-{LINUX.name}"
    files = {path.relative_to(linux.tree).as_posix(): path.read_bytes()
             for path in linux.tree.rglob("*") if path.is_file()}
    files |= {f"share/doc/feedhold/{each}": text for each, text in texts(linux).items()}
    return write_tar_gz(release.out / f"{name}.tar.gz", {f"{name}/{each}": data for each, data in files.items()},
                        release.epoch)


def for_windows(text):
    """Texts with the line ends and the names that its editors know."""
    return text.replace(b"\r\n", b"\n").replace(b"\n", b"\r\n")


def make_zip(release):
    windows = release.built[WINDOWS]
    name = f"feedhold-{release.version}-{WINDOWS.name}"
    written = texts(windows) | {"README": (ROOT / "packaging/windows/README.txt").read_bytes()}
    files = {f"{name}/{WINDOWS.program}": windows.program}
    files |= {f"{name}/{each.removesuffix('.md')}.txt": for_windows(text) for each, text in sorted(written.items())}
    return write_zip(release.out / f"{name}.zip", files, release.epoch)
