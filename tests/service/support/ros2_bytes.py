# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Every message of percuss_msgs, with random members: the CDR that rosbags makes of it from the .msg and .srv
texts is what Cyclone DDS makes of it, to the byte, and what rosbags reads of Cyclone's is the message.
usage: ros2_bytes.py PERCUSS_MSGS_FOLDER ROS2_BYTES"""

import pathlib
import random
import subprocess
import sys

import numpy
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.base import Nodetype

folder, program = pathlib.Path(sys.argv[1]), sys.argv[2]
store = get_typestore(Stores.ROS2_HUMBLE)
definitions = {}
for path in folder.glob("msg/*.msg"):
    definitions |= get_types_from_msg(path.read_text(), f"percuss_msgs/msg/{path.stem}")
# a half of a service is a message; rmw_cyclonedds puts 16 octets in front of it
question, answer = (folder / "srv/Impact.srv").read_text().split("---\n")
head = "uint64 header_guid\nint64 header_number\n"
definitions |= get_types_from_msg(head + question, "percuss_msgs/msg/Impact_Request")
definitions |= get_types_from_msg(head + answer, "percuss_msgs/msg/Impact_Response")
store.register(definitions)
draw = random.Random(66)
drawn = {"bool": lambda: draw.random() < 0.5, "octet": lambda: draw.randrange(256),
         "uint8": lambda: draw.randrange(256), "uint32": lambda: draw.randrange(2**32),
         "uint64": lambda: draw.randrange(2**64), "int64": lambda: draw.randrange(-2**63, 2**63),
         "float64": lambda: draw.uniform(-1e9, 1e9),
         "string": lambda: "".join(draw.choices("abcdefghij-1", k=draw.randrange(12)))}


def value(descriptor):
    kind, detail = descriptor
    if kind == Nodetype.BASE:
        return drawn[detail[0]]()
    if kind == Nodetype.NAME:
        return message(detail)
    element, count = detail
    items = [value(element) for _ in range(count or draw.randrange(4))]
    if element[0] == Nodetype.BASE and element[1][0] != "string":
        return numpy.array(items, dtype=element[1][0].replace("octet", "uint8"))
    return items


def message(name):
    fields = store.get_msgdef(name).fields
    return store.types[name](**{member: value(descriptor) for member, descriptor in fields})


compared = 0
for kind in "Request", "Reply", "BodyList", "Impact_Request", "Impact_Response":
    name = f"percuss_msgs/msg/{kind}"
    for _ in range(8):
        made = bytes(store.serialize_cdr(message(name), name))
        ran = subprocess.run([program, kind], input=made, capture_output=True, check=True)
        # Cyclone DDS fills up to 4 octets, and says by how many
        body, padding = ran.stdout[4:], ran.stdout[3]
        body = body[: len(body) - padding] if padding else body
        assert ran.stdout[:2] == made[:2] == b"\x00\x01", ran.stdout[:4]
        own = made[4:]
        assert body == own, f"{kind}: {len(body)} octets of Cyclone DDS, {len(own)} of rosbags"
        again = store.serialize_cdr(store.deserialize_cdr(ran.stdout, name), name)
        assert bytes(again)[4:] == own, kind
        compared += len(own)
print(f"{compared} octets compared")
assert compared > 10000
