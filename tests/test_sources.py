"""Which sources a result depends on."""

from springblock.sources import code_version, digest, files


def names(*modules):
    return {file.name for file in files(*modules)}


def test_a_simulation_depends_on_the_solver_and_on_no_figure():
    found = names("springblock.commands.simulate")
    assert {"leapfrog.py", "rk4.py", "friction.py", "springs.py", "pattern.py"} <= found
    assert not any(name.startswith("figure_") for name in found)


def test_a_figure_depends_on_itself_and_not_on_the_solver():
    found = names("springblock.commands.figure", "springblock.figures.figure_3")
    assert {"figure_3.py", "style.py", "tables.py"} <= found
    assert not {"figure_2.py", "leapfrog.py", "realisation.py"} & found


def test_the_error_study_depends_on_each_of_its_own_modules():
    kinds = names("springblock.commands.stability")
    assert {"block.py", "cases.py", "load.py", "overflow.py", "pull.py", "reference.py"} <= kinds
    assert {"rest.py", "schemes.py", "size.py", "step.py", "surface.py", "table.py"} <= kinds
    compared = names("springblock.commands.compare")
    assert {"work_precision.py", "reference.py", "plain_rk4.py", "leapfrog.py"} <= compared
    assert not {"page.py", "block.py"} & compared


def test_the_digest_tells_modules_apart_and_is_part_of_the_version():
    assert digest("springblock.material") != digest("springblock.pattern")
    assert code_version("springblock.material").endswith("+" + digest("springblock.material"))
