"""Pages: sentences that the tables contradict are refused by name."""

import pytest
from jinja2 import DictLoader

from springblock.analysis.statistics import Interval
from springblock.study import pages

TEMPLATE = """# A page

{% guard place in (6, 7) %}
Friction is lowest on pillars of {{ place }}: {{ friction | number }}.
{% endguard %}
"""


@pytest.fixture
def page(monkeypatch):
    """Render a template with a guard."""
    monkeypatch.setattr(pages.PAGES, "loader", DictLoader({"page.md": TEMPLATE}))
    return lambda place: pages.rendered("page.md", place=place, friction=Interval(0.62, 0.61, 0.63))


def test_a_guard_leaves_a_sentence_that_holds(page):
    assert page(6) == "# A page\n\nFriction is lowest on pillars of 6: 0.620 [0.610, 0.630].\n"


def test_a_guard_names_the_sentence_that_the_tables_contradict(page):
    with pytest.raises(ValueError, match=r"page.md, line 3: .* “Friction is lowest"):
        page(9)
