"""Archive of a study, with code and results in one file, described as an RO-Crate.

RO-Crate 1.1 (doi:10.5281/zenodo.4541002) in the profile Workflow Run Crate 0.5: the Snakefile is
the workflow; one action has made the results from the configuration and the locked packages.
"""

import hashlib
import json
import platform
import subprocess
import zipfile
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

import yaml
from rocrate.model.contextentity import ContextEntity
from rocrate.rocrate import ROCrate

from springblock.files import whole_file
from springblock.io.identity import RECORD
from springblock.study.audit import needed

CRATE = "ro-crate-metadata.json"
_PROFILES = (
    "https://w3id.org/ro/wfrun/process/0.5",
    "https://w3id.org/ro/wfrun/workflow/0.5",
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0",
)
#: Media types by file name extension; all other files are text.
_TYPES = {
    ".md": "text/markdown",
    ".mp4": "video/mp4",
    ".nc": "application/x-netcdf",
    ".npz": "application/zip",
    ".parquet": "application/vnd.apache.parquet",
    ".pdf": "application/pdf",
    ".png": "image/png",
    ".html": "text/html",
    ".json": "application/json",
    ".yaml": "application/yaml",
}


def archive(study: Path, results: Path, configuration: Path, output: Path) -> int:
    """Pack code, configuration and results of a finished study; return the number of files.

    `results` and `configuration` are in the folder `study`, a clone. Packed are its tracked files
    and those that its record names: no logs, notes or former archives. A link out of the study is a
    ValueError. Modification times are preserved, so that no result appears to be out of date.
    """
    for path in (results, configuration):
        if not path.is_relative_to(study):
            raise ValueError(f"{path} is not in {study}, the folder of the study")
    made = _results(study, results)
    used = configuration.relative_to(study).as_posix()
    files = sorted({*_code(study), used, *made})
    _refuse_links(study, results, files)
    crate = _crate(study, files, made, used)
    with (
        whole_file(output) as partial,
        zipfile.ZipFile(partial, "w", zipfile.ZIP_DEFLATED, strict_timestamps=False) as packed,
    ):
        packed.writestr(CRATE, json.dumps(crate.metadata.generate(), indent=1))
        for name in files:
            packed.write(study / name, name)
    return len(files) + 1


def _code(study: Path) -> list[str]:
    """Return the tracked files of a clone, without archives."""
    if not (study / ".git").exists():
        raise ValueError(f"{study} is not a clone of the study")
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=study, capture_output=True)
    if listed.returncode:
        raise ValueError(f"{study}: git fails: {listed.stderr.decode().partition(chr(10))[0]}")
    names = listed.stdout.decode().split("\0")
    return [name for name in names if (study / name).is_file() and not name.endswith(".zip")]


def _results(study: Path, results: Path) -> list[str]:
    """Return the files of a study, with the preludes and masks from which it can grow."""
    record = needed(results)
    kept = [name for name in record["spare"] if name.startswith(("preludes/", "surfaces/"))]
    names = (results / name for name in (*record["files"], *kept, RECORD))
    return [file.relative_to(study).as_posix() for file in names if file.exists()]


def _refuse_links(study: Path, results: Path, files: list[str]) -> None:
    """Refuse files outside of the study; the folder of results itself may be a link."""
    places = study.resolve(), results.resolve()
    for name in files:
        target = (study / name).resolve()
        if not any(target.is_relative_to(place) for place in places):
            raise ValueError(f"{name} is a link to {target}, outside of the study; replace it")


def _crate(study: Path, files: list[str], made: list[str], configuration: str) -> ROCrate:
    """Describe the study, all its files, and the run that made the results."""
    about = yaml.safe_load((study / "CITATION.cff").read_text(encoding="utf-8"))
    crate = ROCrate(version="1.1")
    crate.name = f"{about['title']} {about['version']}: a study and its results"
    crate.description = about["abstract"]
    crate.license = f"https://spdx.org/licenses/{about['license']}"

    def add(identity: str, kind: str, **properties: Any) -> Any:
        return crate.add(ContextEntity(crate, identity, {"@type": kind, **properties}))

    root = crate.root_dataset
    authors = enumerate(about["authors"])
    root["author"] = [add(f"#{i}", "Organization", name=each["name"]) for i, each in authors]
    paper = about["references"][0]
    doi = f"https://doi.org/{paper['doi']}"
    root["citation"] = add(doi, "ScholarlyArticle", name=paper["title"])
    root["conformsTo"] = [add(url, "CreativeWork", name=url.split("/", 4)[4]) for url in _PROFILES]
    entities = {name: _add_file(crate, study, name) for name in files}
    times = [(study / name).stat().st_mtime for name in made]
    began, ended = (datetime.fromtimestamp(when(times), UTC) for when in (min, max))
    run = add(
        "#run",
        "CreateAction",
        name="The study was run",
        description=f"Python {platform.python_version()}, snakemake {version('snakemake')}, "
        f"{platform.system()} on {platform.machine()}",
        startTime=began.isoformat(timespec="seconds"),
        endTime=ended.isoformat(timespec="seconds"),
    )
    run["instrument"] = crate.mainEntity
    run["object"] = [entities[name] for name in (configuration, "environment.lock")]
    run["result"] = [entities[name] for name in made]
    root["mentions"] = [run]
    return crate


def _add_file(crate: ROCrate, study: Path, name: str) -> Any:
    """Add a file with its type, size and checksum."""
    content = (study / name).read_bytes()
    properties = {
        "name": name,
        "contentSize": str(len(content)),
        "encodingFormat": _TYPES.get(Path(name).suffix, "text/plain"),
        "sha256": hashlib.sha256(content).hexdigest(),
    }
    file = study / name, name
    if name == "Snakefile":
        how = {"main": True, "lang": "snakemake"}
        return crate.add_workflow(*file, **how, properties=properties)
    return crate.add_file(*file, properties=properties)
