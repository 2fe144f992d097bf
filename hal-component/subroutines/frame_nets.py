"""Nets that the HAL file has forgotten, and what is lost without them."""

import hal
import linuxcnc

#: framekins' inputs that motion has to be linked to, and motion's that framekins has to be: (pin, net, what is lost)
NETS = (
    ("framekins.in-position", "net motion-in-position motion.in-position => framekins.in-position",
     "no frame is taken"),
    ("framekins.teleop", "net motion-teleop motion.teleop-mode => framekins.teleop",
     "a frame that changes in teleop mode moves the joints"),
    ("framekins.enabled", "net motion-on motion.motion-enabled => framekins.enabled",
     "a frame does not go when the machine is switched off"),
    ("motion.feed-inhibit", "net frame-hold framekins.hold => motion.feed-inhibit",
     "a program may start before a frame is gone, and nothing holds the machine if frame_guard ends"),
    ("motion.enable", "net frame-guarded framekins.guarded => motion.enable",
     "nothing stops the machine if frame_guard ends"),
)

#: from here on LinuxCNC takes external offsets off by itself where the kinematics change
KNOWN_TO_MOTION = (2, 10)


def missing_nets():
    """What to tell of each that is missing."""
    nets = [*NETS, *nets_of_external_offsets()]
    return [told(*net) for net in nets if not hal.pin_has_writer(net[0])]


def told(pin, net, loss):
    """What to tell of one that is missing."""
    return f"{pin} is not linked, and so {loss}: write into the HAL file: {net}"


def nets_of_external_offsets():
    """Those of the axes that may have such an offset."""
    if series(linuxcnc.version) >= KNOWN_TO_MOTION:
        return []
    pins = {pin["NAME"] for pin in hal.get_info_pins()}
    nets = []
    for letter in "xyzabcuvw":
        switch, pin = f"axis.{letter}.eoffset-enable", f"framekins.external-offset.{letter}"
        if switch in pins and (hal.get_value(switch) or hal.pin_has_writer(switch)):
            nets.append((pin, f"net external-offset-{letter} axis.{letter}.eoffset => {pin}",
                         "the joints jump by the external offset where a frame comes or goes"))
    return nets


def series(version):
    """The first two numbers of a version, (2, 9) of 2.9.4 and of 2.9.0~pre1."""
    major, minor = version.split(".")[:2]
    return int(major), int("".join(digit for digit in minor if digit.isdigit()) or 0)
