"""Files of weights and of the state of a training."""
import io
import json
import pickle
import zipfile

import torch

from .network import YoloV8
from .whole_file import whole

STATE = ("network", "optimizer", "losses")  # tensors of a training that can go on


class CheckpointError(Exception):
    pass


def save(path, facts, tensors):
    """`facts` is plain data; it travels as JSON, since torch 1.13 reads no plain number from a file it does not trust.
    Raises OSError."""
    content = io.BytesIO()  # torch ends the process where a file cannot be written to
    torch.save({"facts": json.dumps(facts), **tensors}, content)
    with whole(path) as part:
        part.write_bytes(content.getbuffer())


def contents(path):
    """Whatever torch saved there. It does not check what it reads, so the sums of the zip file are."""
    with zipfile.ZipFile(path) as file:
        if file.testzip():
            raise ValueError("it is damaged: its sums are not those of its contents")
    try:
        return torch.load(path, map_location="cpu", weights_only=True)
    except pickle.UnpicklingError:  # torch would advise to trust the file
        raise ValueError("it holds more than numbers and texts") from None


def load(path, resumed=False):
    """(facts, tensors). `resumed`: with the state of the training."""
    try:
        tensors = contents(path)
        facts = json.loads(tensors.pop("facts"))
        missing = [key for key in ("config", "names", "size") if key not in facts]
        missing += [key for key in ("weights", *STATE * resumed) if key not in tensors]
    except Exception as fault:  # of the file system, of zip, of pickle: all mean the same here
        raise CheckpointError(f"{path}: no checkpoint of train_detector: {fault}") from None
    if resumed and "state" not in facts:
        raise CheckpointError(f"{path}: it lacks the state of the training, only last.pt can be resumed")
    if missing:
        raise CheckpointError(f"{path}: it lacks {', '.join(missing)}")
    return facts, tensors


def network_of(facts, tensors):
    """The trained network (averaged weights), in evaluation mode."""
    network = YoloV8(**facts["config"])
    network.load_state_dict(tensors["weights"])
    return network.eval()
