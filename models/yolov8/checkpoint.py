"""Files of weights and of the state of a training."""
import json
import os
import pathlib

import torch

from .network import YoloV8


class CheckpointError(Exception):
    pass


def save(path, facts, tensors):
    """Whole or not at all: a reader never sees half a file, nor does an interruption leave one.
    `facts` is plain data; it travels as JSON, since torch 1.13 reads no plain number from a file it does not trust."""
    path = pathlib.Path(path)
    part = path.with_name(path.name + ".part")
    with open(part, "wb") as stream:
        torch.save({"facts": json.dumps(facts), **tensors}, stream)
        stream.flush()
        os.fsync(stream.fileno())
    os.replace(part, path)


def load(path, *wanted):
    """(facts, tensors). `wanted`: facts beyond what every checkpoint has."""
    try:
        tensors = torch.load(path, map_location="cpu", weights_only=True)
        facts = json.loads(tensors.pop("facts"))
        missing = [key for key in ("config", "names", "size", *wanted) if key not in facts]
    except Exception as fault:  # of the file system, of zip, of pickle: all mean the same here
        raise CheckpointError(f"{path}: no checkpoint of train_detector: {fault}") from None
    if missing:
        raise CheckpointError(f"{path}: it lacks {', '.join(missing)}" + (", only last.pt can be resumed" if wanted else ""))
    return facts, tensors


def network_of(facts, tensors):
    """The trained network (averaged weights), in evaluation mode."""
    network = YoloV8(**facts["config"])
    network.load_state_dict(tensors["weights"])
    return network.eval()
