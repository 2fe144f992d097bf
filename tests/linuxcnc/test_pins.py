"""Pins of framekins: values that nothing can be made of, of which the operator is told which, and external offsets."""

import ctypes
import math
import os
import unittest

import harness
import kinematics_host

FLOAT, BIT = ctypes.c_double, ctypes.c_bool

#: servo periods that motion has to have stood, see src/kinematics/release.rs
SETTLED = 4

#: of framekins.refusal
OFFSETS_MOVE, UNKNOWN_OFFSET = 21, 22


class Framekins(unittest.TestCase):
    def setUp(self):
        self.module = kinematics_host.Module(os.path.join(harness.MODULES, "framekins.so"), "framekins",
                                             coordinates="XYZAC", machine="xyzac")
        for pin in ("command", "value.1", "value.2", "work-offset.y", "tool-offset.z", "x-rot-point", "y-offset",
                    "tool-offset", "map.xx", "map.z"):
            self.module.find(pin, FLOAT)
        for pin in ("in-position", "parameters-pending"):
            self.module.find(pin, BIT)
        self.module.set(in_position=True)
        for _ in range(SETTLED):
            self.module.update()
        self.said = len(self.messages())

    def messages(self):
        return self.module.host.host_messages().decode().splitlines()

    def new_messages(self):
        return self.messages()[self.said:]

    def test_a_refused_frame_names_the_pin(self):
        for pin, value in (("value.2", math.nan), ("work-offset.y", math.inf), ("tool-offset.z", -math.inf),
                           ("work-offset.y", 1e7), ("map.xx", math.nan), ("map.z", 1e7)):
            with self.subTest(pin=pin, value=value):
                self.setUp()
                before = self.module.pins[pin].value
                code = 12 if pin.startswith("map") else 1
                self.module.set(**{pin: value, "command": 1000.0 + code})
                self.module.update()
                said = self.new_messages()
                self.assertEqual(len(said), 2, said)
                self.assertIn("frame refused", said[0])
                self.assertIn(f"framekins.{pin} is {value:g}, which is no", said[1])
                self.assertIn("look at what sets it in the HAL file", said[1])
                self.module.set(**{pin: before})

    def test_a_frame_that_is_refused_for_another_reason_names_none(self):
        self.module.set(command=1099.0)
        self.module.update()
        self.assertEqual(len(self.new_messages()), 1, self.new_messages())

    def test_a_dimension_of_the_table_is_named_when_it_becomes_impossible(self):
        self.module.set(**{"x-rot-point": math.inf})
        for _ in range(3):
            self.module.update()
        self.assertTrue(self.module.pins["parameters-pending"].value)
        said = self.new_messages()
        self.assertEqual(len(said), 1, said)
        self.assertIn("framekins.x-rot-point is inf, which is no length of a machine", said[0])


@unittest.skipIf(harness.HANDS_OVER_JERK, "LinuxCNC 2.10 takes them off itself")
class ExternalOffsets(unittest.TestCase):
    JOINTS = (10.0, 20.0, 30.0)

    def setUp(self):
        self.module = kinematics_host.Module(os.path.join(harness.MODULES, "framekins.so"), "framekins", coordinates="XYZ")
        for pin in ("in-position", "enabled"):
            self.module.find(pin, BIT)
        for letter in "yz":
            self.module.link(f"external-offset.{letter}")
        for letter in "xyz":
            self.module.find(f"external-offset.{letter}", FLOAT)
        self.module.find("command", FLOAT)
        self.module.set(**{"in-position": True, "external-offset.y": 2.0, "external-offset.z": -3.0})

    def forward(self):
        return self.module.forward(self.JOINTS)[:3]

    def messages(self):
        return self.module.host.host_messages().decode().splitlines()

    def test_are_off_the_place_that_follows_a_switch_and_off_no_other(self):
        self.assertEqual(self.forward(), [10, 20, 30])
        self.assertEqual(self.module.switch(0), 0)
        self.assertEqual(self.forward(), [10, 18, 33])
        self.assertEqual(self.forward(), [10, 20, 30])

    def test_stay_on_behind_a_switch_that_is_refused(self):
        self.assertNotEqual(self.module.switch(99), 0)
        self.assertEqual(self.forward(), [10, 20, 30])

    def test_what_cannot_be_one_is_refused_and_named(self):
        for pin, value in (("x", 100.0), ("y", math.nan), ("y", math.inf), ("z", 1e7)):
            with self.subTest(pin=pin, value=value):
                self.setUp()
                self.module.set(**{f"external-offset.{pin}": value})
                self.assertEqual(self.module.switch(1), UNKNOWN_OFFSET)
                self.module.set(**{f"external-offset.{pin}": 0.0})
                self.assertEqual(self.module.switch(2), 0)

    def test_are_none_with_the_machine_off(self):
        self.module.set(**{"enabled": False, "external-offset.x": 100.0, "external-offset.z": math.nan})
        self.assertEqual(self.module.switch(0), 0)
        self.assertEqual(self.forward(), [10, 18, 30])

    def test_have_to_stand(self):
        for place in (0.0, 0.0, 0.1):
            self.module.inverse([place] + 8 * [0.0])
            self.module.update()
        for _ in range(SETTLED - 1):
            self.assertEqual(self.module.switch(1), OFFSETS_MOVE)
            self.module.update()
        self.assertEqual(self.module.switch(2), 0)

    def test_joints_that_would_jump_have_no_answer(self):
        for told, goes_on in ((2.0, True), (2.5, False)):
            with self.subTest(told=told):
                self.setUp()
                self.module.set(**{"external-offset.y": told})
                self.assertEqual(self.module.switch(0), 0)
                # in motion's own place, to which it adds the offsets
                place, joints = kinematics_host.Pose(), kinematics_host.Joints(*self.JOINTS)
                flags = ctypes.byref(self.module.flags)
                self.assertEqual(self.module.library.kinematicsForward(joints, place, flags, flags), 0)
                place[1] += 2.0
                place[2] += -3.0
                answer = self.module.library.kinematicsInverse(place, joints, flags, flags)
                self.assertEqual((answer, len(self.messages())), (0, 0) if goes_on else (-1, 2))


if __name__ == "__main__":
    unittest.main()
