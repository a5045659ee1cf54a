"""What all tests share: helper modules beside this file can be imported, and Hypothesis minds no slow machine."""

from hypothesis import settings

settings.register_profile("axcomp", deadline=None)
settings.load_profile("axcomp")
