"""What loop functions of ARGoS3 ask about entities."""

from running import HERE, RunningTest


class Queries(RunningTest):
    def test_parts_anchors_boxes_and_robots_that_hear_each_other(self):
        self.swarmanoid("run", HERE / "look.argos", "--output", "run")
        lines = (self.folder / "looks.txt").read_text().splitlines()
        told = [line for line in lines if not line.startswith("heard")]
        self.assertEqual(told, [
            "anchor 0,0.1,0.2 0",
            "enabled 1",
            "refused anchor: the body of 'a' has no anchor 'mist'; it has: origin, mast. AddAnchor makes others",
            "box a -0.085,-0.085,0 0.085,0.085,0.1469",
            "box turned -1.1,-1.2,0 -0.9,-0.8,0.3",
            "parts 10 100",
            "led led_3 leds a.leds_0.",
            "refused part: entity 'a' has no component 'wings'; it has: body, battery, gripper, controller, leds, rab, wheels, proximity_sensors, light_sensors, ground_sensors",
            "model engine 10",
            "refused model: the body of 'a' has no physics model 1; it has one, 0",
            # The robot looks along y.
            "sensor 24 0.0843,0.0111,0.06 -0.0241,0.1834,0.06",
            "ground 12 0.08,0 10",
            "light 24 0.1",
            "refused sensor: sensor 24 of the 24 of 'a.proximity_0'; the first one is 0",
            "nowhere 0",
            "refused parent: entity 'a' is no part of another one",
            "order 0 0 1",
            "word spoken",
            "refused controller: <controllers> has no controller 'x'",
            "drawn 1",
            "engines 1 dyn2d",
            # The wall stands between a and hidden; far is 3.5 m away.
            "hears a: b",
            "hears b: a hidden",
            "hears hidden: b",
            "hears far:",
            "copied 1 rab",
            "antenna 0,0,0.1 1",
            "written 76 0 0 0 0 0 0 0 0 0",
            "moved 0.1,-1,0.2",
        ])
        # What was written before the second step is heard in it; then b sends zeros again.
        heard = [line for line in lines if line.startswith("heard")]
        self.assertEqual(heard[:3], ["heard 1: 0", "heard 2: 77", "heard 3: 0"])
