"""The list of guidance laws: a new law is one entry here."""

from __future__ import annotations

from auv_path_following.guidance.laws import ailos, ilos, los, vector_field
from auv_path_following.registry import chosen_step

#: The first is the default.
LAWS = (ailos.LAW, ilos.LAW, los.LAW, vector_field.LAW)

law_step = chosen_step(LAWS)
