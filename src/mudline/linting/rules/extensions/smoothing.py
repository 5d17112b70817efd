"""Which elements `*SEABED CONTACT` gives a smoothed law."""

from __future__ import annotations

import numpy as np

from mudline.contact.input import LawKind
from mudline.scene.contact_parts.picking import marked
from mudline.scene.contact_parts.smoothing import KEYWORD, is_auto
from mudline.scene.given import number
from mudline.scene.model import Scene
from mudline.scene.numbering import Mask
from mudline.scene.section_weight import submerged_weight


def smoothed(scene: Scene) -> Mask:
    """Elements with a linear or nodal law that is smoothed; AUTO smooths under a known submerged weight only."""
    contact = scene.extensions.get(KEYWORD)
    if contact is None:
        return np.zeros(len(scene.element_ids), dtype=np.bool_)
    fixed = marked((number(entry, "smoothing") > 0.0 for entry in contact.entries), contact.of_element)
    auto = marked(map(is_auto, contact.entries), contact.of_element)
    if auto.any():
        auto &= submerged_weight(scene) > 0.0
    law: Mask = np.isin(scene.law, (LawKind.LINEAR, LawKind.NODAL))
    return (fixed | auto) & law
