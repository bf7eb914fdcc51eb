"""``python -m rock_field_dask``."""

import sys

from .main import main

sys.exit(main())
