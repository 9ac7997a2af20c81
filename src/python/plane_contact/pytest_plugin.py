"""A fixture of pytest, there wherever plane_contact is installed."""

from collections.abc import Callable
from typing import Any

import pytest

import plane_contact


@pytest.fixture(scope="session")
def plane_contact_reference() -> Callable[..., dict[str, Any]]:
    """The function that returns the reference solution of a scene, to hold one's own against."""
    return plane_contact.reference
