"""springblock beyond."""


def test_what_was_not_simulated_is_not_answered(springblock, batch, pillars, tmp_path):
    page = tmp_path / "beyond.md"
    springblock("beyond", batch(0, 2), *pillars, "--output", page)
    text = page.read_text(encoding="utf-8")
    assert "**Not answered**: this needs the groups lattice, disorder and layer." in text
    assert "| flat | " in text  # clusters of precursors


def test_what_is_no_batch_is_refused(springblock, tmp_path):
    (text := tmp_path / "text").write_text("text")
    refusal = springblock("beyond", text, "--output", tmp_path / "page.md", refused=True)
    assert "Parquet" in refusal
    assert list(tmp_path.iterdir()) == [text]
