"""The program with its manual page and completions, to be unpacked anywhere."""
from release import write_tar_gz
from texts import texts


def make(release):
    name = f"feedhold-{release.version}-linux-x86_64"
    files = {path.relative_to(release.tree).as_posix(): path.read_bytes()
             for path in release.tree.rglob("*") if path.is_file()}
    files |= {f"share/doc/feedhold/{each}": text for each, text in texts(release).items()}
    return write_tar_gz(release.out / f"{name}.tar.gz", {f"{name}/{each}": data for each, data in files.items()},
                        release.epoch)
