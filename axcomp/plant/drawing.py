"""Parameters of a plant that are drawn: ``{"from": 0.005, "to": 0.05}`` in place of a number."""

from __future__ import annotations

import random
from typing import Any


def drawn(description: Any, seed: int) -> Any:
    """Return a description with a number for each range, the same for the same seed; evenly distributed."""
    source = random.Random(seed)

    def draw(item: Any) -> Any:
        if isinstance(item, dict):
            if item.keys() == {"from", "to"}:
                return source.uniform(item["from"], item["to"])
            return {name: draw(value) for name, value in item.items()}
        return [draw(value) for value in item] if isinstance(item, list) else item

    return draw(description)
