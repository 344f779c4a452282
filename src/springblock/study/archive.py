"""Archive of a study, with code and results in one file, described as an RO-Crate.

RO-Crate 1.1 (doi:10.5281/zenodo.4541002) in the profile Workflow Run Crate 0.5: the Snakefile is
the workflow; one action has made the results from the configuration and the locked packages.
"""

import hashlib
import json
import platform
import subprocess
import zipfile
from collections.abc import Iterable
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

import yaml
from rocrate.model.contextentity import ContextEntity
from rocrate.rocrate import ROCrate

from springblock.files import whole_file

CRATE = "ro-crate-metadata.json"
_PROFILES = [
    "https://w3id.org/ro/wfrun/process/0.5",
    "https://w3id.org/ro/wfrun/workflow/0.5",
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0",
]
#: Media types by file name extension; all other files are text.
_TYPES = {
    ".md": "text/markdown",
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
    """Write code, configuration and results of a finished study into one zip file.

    `results` and `configuration` are in the folder `study`. Logs and untracked files of the study
    are omitted. Modification times are preserved, so that no result appears to be out of date.

    Returns
    -------
    int
        Number of files in the archive.

    Raises
    ------
    ValueError
        If the folder is neither a clone nor an unpacked archive, or has no results.
    """
    made = _results(study, results)
    files = sorted({*_code(study), *made})
    crate = _crate(study, files, made, configuration.relative_to(study).as_posix())
    with (
        whole_file(output) as partial,
        zipfile.ZipFile(partial, "w", zipfile.ZIP_DEFLATED, strict_timestamps=False) as packed,
    ):
        packed.writestr(CRATE, json.dumps(crate, indent=1))
        for name in files:
            packed.write(study / name, name)
    return len(files) + 1


def _code(study: Path) -> list[str]:
    """Return the tracked files of a clone, or the files listed in an unpacked archive."""
    if (study / ".git").exists():
        listed = subprocess.run(
            ["git", "ls-files", "-z"], cwd=study, capture_output=True, check=True
        )
        return [name for name in listed.stdout.decode().split("\0") if (study / name).is_file()]
    if (study / CRATE).is_file():
        described = json.loads((study / CRATE).read_text(encoding="utf-8"))["@graph"]
        names = (entity["@id"] for entity in described if "sha256" in entity)
        return [name for name in names if (study / name).is_file()]
    raise ValueError(f"{study} is neither a clone of the study nor an unpacked archive")


def _results(study: Path, results: Path) -> list[str]:
    """Return the results of the study, without logs and run times."""
    aside = {"benchmarks", "logs", "set-aside"}
    found = (file.relative_to(results) for file in sorted(results.rglob("*")) if file.is_file())
    kept = [name for name in found if name.parts[0] not in aside and not name.name.startswith(".")]
    if not any(name.parts[0] == "tables" for name in kept):
        raise ValueError(f"{results} has no tables; run the study first")
    return [(results / name).relative_to(study).as_posix() for name in kept]


def _crate(study: Path, files: Iterable[str], made: list[str], configuration: str) -> Any:
    """Metadata of the crate, as JSON."""
    about = yaml.safe_load((study / "CITATION.cff").read_text(encoding="utf-8"))
    crate = ROCrate(version="1.1")
    crate.name = f"{about['title']} {about['version']}: a study and its results"
    crate.description = about["abstract"]
    crate.license = f"https://spdx.org/licenses/{about['license']}"
    people = [{"@type": "Organization", "name": each["name"]} for each in about["authors"]]
    author = [crate.add(ContextEntity(crate, f"#{i}", each)) for i, each in enumerate(people)]
    crate.root_dataset["author"] = author
    cited = f"https://doi.org/{about['references'][0]['doi']}"
    paper = {"@type": "ScholarlyArticle", "name": about["references"][0]["title"]}
    crate.root_dataset["citation"] = crate.add(ContextEntity(crate, cited, paper))
    kinds = {url: {"@type": "CreativeWork", "name": url.split("/", 4)[4]} for url in _PROFILES}
    profiles = [crate.add(ContextEntity(crate, url, kind)) for url, kind in kinds.items()]
    entities = {name: _add(crate, study, name) for name in files}
    results = [entities[name] for name in made]
    crate.root_dataset["conformsTo"] = profiles
    crate.root_dataset["mentions"] = [_action(crate, study, entities, results, configuration)]
    return crate.metadata.generate()


def _add(crate: ROCrate, study: Path, name: str) -> Any:
    """Add a file with its type, size and checksum."""
    content = (study / name).read_bytes()
    properties = {
        "name": name,
        "contentSize": str(len(content)),
        "encodingFormat": _TYPES.get(Path(name).suffix, "text/plain"),
        "sha256": hashlib.sha256(content).hexdigest(),
    }
    if name != "Snakefile":
        return crate.add_file(study / name, name, properties=properties)
    return crate.add_workflow(
        study / name, name, main=True, lang="snakemake", properties=properties
    )


def _action(
    crate: ROCrate, study: Path, entities: dict[str, Any], results: list[Any], configuration: str
) -> Any:
    """Describe the run: its inputs, its results and its times."""
    times = [(study / entity.id).stat().st_mtime for entity in results]
    began, ended = (datetime.fromtimestamp(when(times), UTC) for when in (min, max))
    properties = {
        "@type": "CreateAction",
        "name": "The study was run",
        "description": f"Python {platform.python_version()}, snakemake {version('snakemake')}, "
        f"{platform.system()} on {platform.machine()}",
        "startTime": began.isoformat(timespec="seconds"),
        "endTime": ended.isoformat(timespec="seconds"),
    }
    action = crate.add(ContextEntity(crate, "#run", properties))
    action["instrument"] = crate.mainEntity
    action["object"] = [entities[name] for name in (configuration, "environment.lock")]
    action["result"] = results
    return action
