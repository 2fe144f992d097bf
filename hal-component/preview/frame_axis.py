"""[DISPLAY]USER_COMMAND_FILE of AXIS: preview, extents, warnings of limits, live plot and position display follow frames.

With a USER_COMMAND_FILE of your own write these lines into it instead, with the folder of this file:

    import sys
    sys.path.insert(0, "/usr/share/framepath/preview")
    import axis_frames
    axis_frames.install(globals())
"""

import os
import sys

# AXIS runs this text among its own names, of which `rcfile` is the way here.
sys.path.insert(0, os.path.dirname(os.path.realpath(globals()["rcfile"])))

import axis_frames

axis_frames.install(globals())
