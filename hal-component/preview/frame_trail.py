"""The live plot where the machine is: what linuxcnc.positionlogger does, from positions behind the frame.

It has the methods that screens call of the one in LinuxCNC, which draws positions in the coordinates of the frame.
"""

import math
import threading
import time

import numpy
from OpenGL import GL

#: points that are kept; then the oldest tenth goes
MOST = 10000

#: machine units within which points are one
SAME = 1e-6

#: a point between two others is left out where the path bends by less, as the square of the sine
STRAIGHT = 1e-12

#: a point as LinuxCNC 2.10 hands it from its own live plot to what draws it; the second place and shade are of foam
LOGGED = numpy.dtype([("place", "<f4", 3), ("shade", "u1", 4), ("foam_place", "<f4", 3), ("foam_shade", "u1", 4)])


def vertex(place, geometry: str):
    """Where nine axes are drawn: letters of [DISPLAY]GEOMETRY in the order in which screens apply them."""
    point = [0.0, 0.0, 0.0]
    sign = 1.0
    for letter in geometry:
        if letter == "-":
            sign = -1.0
            continue
        if letter in "XYZ":
            point["XYZ".index(letter)] += sign * place["XYZ".index(letter)]
        elif letter in "UVW":
            point["UVW".index(letter)] += sign * place[6 + "UVW".index(letter)]
        elif letter in "ABC":
            axis = "ABC".index(letter)
            c, s = (f(math.radians(sign * place[3 + axis])) for f in (math.cos, math.sin))
            first, second = (axis + 1) % 3, (axis + 2) % 3
            point[first], point[second] = c * point[first] - s * point[second], s * point[first] + c * point[second]
        sign = 1.0
    return tuple(point)


class FrameTrail:
    """A live plot."""

    def __init__(self, look, colours, geometry: str):
        """look(): the tip of the tool as nine axes in machine units, and motion's type of motion; None while LinuxCNC does not
        answer. colours: red, green, blue and alpha from 0 to 255, for each type of motion."""
        self.look = look
        self.colours = colours
        self.geometry = geometry
        self.lock = threading.Lock()
        self.places = numpy.empty((MOST, 3))
        self.shades = numpy.empty((MOST, 4), numpy.uint8)
        self.npts = 0
        self.running = False
        self.place = None

    def start(self, interval: float):
        """Looks every so many seconds until it is stopped; in a thread of its own. A second start does nothing."""
        with self.lock:
            if self.running:
                return
            self.running = True
        while self.running:
            found = self.look()
            if found:
                self.add(*found)
            time.sleep(interval)

    def stop(self):
        self.running = False

    def clear(self):
        with self.lock:
            self.npts = 0

    def get_colors(self):
        return tuple(tuple(colour) for colour in self.colours)

    def set_colors(self, *colours):
        """Colours of what comes now, as many as get_colors gives."""
        self.colours = colours

    def set_depth(self, z, w):
        """For machines that cut foam, which have no frames."""

    def add(self, place, motion_type: int):
        """Where the machine is now."""
        self.place = place
        point = vertex(place, self.geometry)
        shade = self.colours[motion_type if 0 <= motion_type < len(self.colours) else 0]
        with self.lock:
            count = self.npts
            if count and numpy.abs(self.places[count - 1] - point).max() < SAME:
                return
            same_shade = bool(count) and tuple(self.shades[count - 1]) == tuple(shade)
            if count > 1 and same_shade and self._goes_straight_on(count, point):
                self.places[count - 1] = point
                return
            if count and not same_shade:
                # the stretch from there on has the colour of where it leads
                self._append(self.places[count - 1], shade)
            self._append(point, shade)

    def _append(self, point, shade):
        if self.npts == MOST:
            kept = MOST - MOST // 10
            self.places[:kept] = self.places[-kept:].copy()
            self.shades[:kept] = self.shades[-kept:].copy()
            self.npts = kept
        self.places[self.npts] = point
        self.shades[self.npts] = shade
        self.npts += 1

    def _goes_straight_on(self, count, point) -> bool:
        before = self.places[count - 1] - self.places[count - 2]
        now = point - self.places[count - 1]
        forward = before @ now
        return forward > 0 and forward * forward > (before @ before) * (now @ now) * (1 - STRAIGHT)

    def points(self):
        """What LinuxCNC 2.10 draws: points in machine units, each a LOGGED, how many they are, and that it is no foam."""
        points, shades = self._now()
        logged = numpy.zeros(len(points), LOGGED)
        logged["place"], logged["shade"] = points, shades
        return logged.tobytes(), len(points), 0

    def _now(self):
        """Points and their shades as they are now."""
        with self.lock:
            return self.places[:self.npts].copy(), self.shades[:self.npts].copy()

    def call(self):
        """Draws it, in machine units: LinuxCNC 2.9."""
        points, shades = self._now()
        if not len(points):
            return
        GL.glEnableClientState(GL.GL_VERTEX_ARRAY)
        GL.glEnableClientState(GL.GL_COLOR_ARRAY)
        GL.glVertexPointer(3, GL.GL_DOUBLE, 0, points)
        GL.glColorPointer(4, GL.GL_UNSIGNED_BYTE, 0, shades)
        GL.glDrawArrays(GL.GL_LINE_STRIP, 0, len(points))
        GL.glDisableClientState(GL.GL_COLOR_ARRAY)
        GL.glDisableClientState(GL.GL_VERTEX_ARRAY)

    def last(self, live=1):
        """Where the tool is drawn: X Y Z, and the angles of A B C; None if nothing is known."""
        del live
        if self.place is None:
            return None
        a, b, c = self.place[3:6]
        return (*vertex(self.place, self.geometry), a, -b, c)
