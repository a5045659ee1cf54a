from axcomp.interface import AXIS_DECLARATIONS, PAGE, README, readme_with_section, reference_page


def test_the_page_is_current() -> None:
    assert PAGE.read_text(encoding="utf-8") == reference_page(), "run python -m axcomp.interface"


def test_the_list_in_the_readme_is_current() -> None:
    readme = README.read_text(encoding="utf-8")
    assert readme == readme_with_section(readme), "run python -m axcomp.interface"


def test_every_variable_of_an_axis_stands_on_it() -> None:
    assert all(f"| `NAME.{declaration.name}` |" in reference_page() for declaration in AXIS_DECLARATIONS)
