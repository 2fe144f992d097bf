"""[DISPLAY]USER_COMMAND_FILE of qtdragon and other screens of qtvcp: preview, extents, warnings of limits, live plot and
positions follow frames.

With a USER_COMMAND_FILE of your own write these lines into it instead, with the folder of this file:

    import sys
    sys.path.insert(0, "/usr/share/framepath/preview")
    import qtvcp_frames
    qtvcp_frames.install(self)
"""

import os
import sys

# qtvcp runs this text beside two names of its own: `rcfile`, the way here, and `self`.
sys.path.insert(0, os.path.dirname(os.path.realpath(locals()["rcfile"])))

import qtvcp_frames

qtvcp_frames.install(locals()["self"])
