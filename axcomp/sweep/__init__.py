"""Many runs over varied lists, inputs and parameters: ``axcomp sweep``."""
