#!/usr/bin/env python3
"""The hashes of ROS 2's message types that endpoints say (real_robot/drivers/ros2/ros2_types.cpp) are those of the messages in idl/ros2,
by the rule of ROS 2 (RIHS01: SHA-256 of a description as JSON): as those that ROS 2 has published for some of them."""
import hashlib
import json
import pathlib
import re
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]
# From the packages of ROS 2 Jazzy; a hash is the same in each release in which the message is.
PUBLISHED = {
    "builtin_interfaces/msg/Time": "b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197",
    "geometry_msgs/msg/Twist": "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a",
    "nav_msgs/msg/Odometry": "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0",
    "rosgraph_msgs/msg/Clock": "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564",
    "sensor_msgs/msg/Imu": "7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b",
    "sensor_msgs/msg/JointState": "a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e",
    "sensor_msgs/msg/LaserScan": "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
    "sensor_msgs/msg/PointCloud2": "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5",
    "std_msgs/msg/Header": "f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01",
    "tf2_msgs/msg/TFMessage": "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
    "visualization_msgs/msg/MarkerArray": "86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf",
}
# type_description_interfaces/msg/FieldType. An octet is a uint8 in all messages that are here.
BASIC = {"octet": 3, "long": 6, "unsigned long": 7, "float": 10, "double": 11, "boolean": 15, "string": 17}
ARRAY, SEQUENCE, NESTED = 48, 144, 1


def structs():
    """The fields of each message: name, type, and how many there are (None: one, 0: any number)."""
    found = {}
    for path in sorted((TOP / "idl/ros2").glob("*.idl")):
        for name, body in re.findall(r"struct (\w+)_\s*\{(.*?)\};", path.read_text(), re.S):
            fields = found[f"{path.stem}/msg/{name}"] = []
            for line in filter(None, map(str.strip, re.sub(r"//.*", "", body).split(";"))):
                kind, field, count = re.fullmatch(r"(.+?)\s+(\w+)(?:\[(\d+)\])?", line).groups()
                if sequence := re.fullmatch(r"sequence<(.+)>", kind):
                    kind, count = sequence[1], 0
                if kind not in BASIC:
                    package, _, message = kind.rpartition("::msg::dds_::")
                    kind = f"{package or path.stem}/msg/{message.rstrip('_')}"
                fields.append((field, kind, None if count is None else int(count)))
    return found


def hash_of(message, messages):
    def needs(one):
        return {one}.union(*(needs(kind) for _, kind, _ in messages[one] if kind not in BASIC))

    def described(one):
        return {"type_name": one, "fields": [{"name": field, "type": {
            "type_id": BASIC.get(kind, NESTED) + (0 if count is None else ARRAY if count else SEQUENCE), "capacity": count or 0,
            "string_capacity": 0, "nested_type_name": "" if kind in BASIC else kind}} for field, kind, count in messages[one]]}

    text = json.dumps({"type_description": described(message),
                       "referenced_type_descriptions": [described(one) for one in sorted(needs(message) - {message})]})
    return hashlib.sha256(text.encode()).hexdigest()


def main():
    messages = structs()
    wrong = [f"{message}: {hash_of(message, messages)}, but ROS 2 has published {expected}" for message, expected in PUBLISHED.items()
             if hash_of(message, messages) != expected]
    source = (TOP / "real_robot/drivers/ros2/ros2_types.cpp").read_text()
    said = re.findall(r'ROS2_MESSAGE\((\w+), (\w+),\s*"RIHS01_(\w+)"\)', source)
    if len(said) != source.count("\nROS2_MESSAGE("):
        wrong.append("ros2_types.cpp: a line is not read")
    wrong += [f"ros2_types.cpp: {package}/msg/{name} says {value}, its hash is {hash_of(f'{package}/msg/{name}', messages)}"
              for package, name, value in said if hash_of(f"{package}/msg/{name}", messages) != value]
    print("\n".join(wrong) or f"{len(said)} hashes")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
