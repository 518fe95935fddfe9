"""``python -m cardan`` is ``cardan``."""

import sys

from cardan.cli.main import main

sys.exit(main())
