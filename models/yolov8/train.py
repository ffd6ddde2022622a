"""The training itself: steps, checkpoints, resuming."""
import dataclasses
import pathlib
import time

import torch

from . import checkpoint
from .augment import Augmentation
from .average import Average
from .average_precision import ALL
from .evaluate import runner, score
from .loader import Loader, network_input
from .loss import detection_loss
from .schedule import Plan, rate_factor
from .start import first_network

SAVE_SECONDS = 120
LONGEST_GRADIENT = 10.0
WEIGHT_DECAY = {"adamw": 0.02, "sgd": 0.0005}
WINDOW = 0.5
STATE = ("epoch", "step", "seconds", "best")
RATES = {"adamw": 0.002, "sgd": 0.01}


@dataclasses.dataclass
class Settings:
    """What a training was started with; a resumed one takes them from its checkpoint."""
    epochs: int = None
    minutes: float = None
    width: float = 0.25
    depth: float = 1 / 3
    size: tuple = (640, 640)     # (width, height) of the input [px]
    batch: int = 16
    seed: int = 0
    optimizer: str = "adamw"
    rate: float = None           # highest learning rate; None: the optimizer's usual
    mosaic: float = 1.0          # share of samples made of four images
    plain: float = 0.1           # last share of the training, which sees no mosaics
    cuttings: float = 0.0        # first share of the training, on quarters of images: four times as many fit
    validate: int = 5            # epochs from one validation to the next
    workers: int = 1             # threads that make batches
    bf16: bool = False
    weights: str = None          # checkpoint or exported detector whose weights it begins with; None: random ones


def make_optimizer(network, settings):
    """Weight decay is for the convolutions' weights only."""
    decayed = [p for p in network.parameters() if p.ndim > 1]
    others = [p for p in network.parameters() if p.ndim <= 1]
    groups = [{"params": decayed, "weight_decay": WEIGHT_DECAY[settings.optimizer]},
              {"params": others, "weight_decay": 0.0}]
    rate = settings.rate or RATES[settings.optimizer]
    if settings.optimizer == "sgd":
        return torch.optim.SGD(groups, rate, momentum=0.937, nesterov=True), rate
    return torch.optim.AdamW(groups, rate, betas=(0.9, 0.999)), rate


class Training:
    def __init__(self, settings, data, validation, out, report, device=None):
        self.settings, self.validation, self.report = settings, validation, report
        self.out = pathlib.Path(out)
        self.device = device or ("cuda" if torch.cuda.is_available() else "cpu")
        self.plan = Plan(settings.epochs, settings.minutes)
        torch.manual_seed(settings.seed)
        network = first_network(settings, data)
        self.names, self.images = data.names, data.fingerprint()
        self.network = network.to(self.device, memory_format=torch.channels_last)
        self.average = Average(self.network)
        self.optimizer, self.rate = make_optimizer(self.network, settings)
        self.loader = Loader(data, settings.batch, settings.seed, settings.workers)
        self.epoch = self.step = 0       # step: of the epoch
        self.seconds = 0.0               # of training so far, interruptions left out
        self.losses = torch.zeros(3)     # sums over the epoch's steps
        self.history, self.best = [], -1.0
        self.stop = False                # set it from a signal handler: the next step is the last

    # -- state ------------------------------------------------------------------------------------------
    def save(self, name="last.pt", with_state=True):
        facts = {"config": self.network.config, "names": self.names, "size": self.settings.size, "images": self.images,
                 "settings": dataclasses.asdict(self.settings), "history": self.history}
        tensors = {"weights": self.average.network.state_dict()}
        if with_state:
            facts["state"] = {**{name: getattr(self, name) for name in STATE}, "updates": self.average.updates}
            tensors.update(network=self.network.state_dict(), optimizer=self.optimizer.state_dict()["state"],
                           losses=self.losses)
        checkpoint.save(self.out / name, facts, tensors)
        self.saved_at = time.monotonic()

    def restore(self, facts, tensors):
        for name in STATE:
            setattr(self, name, facts["state"][name])
        self.history, self.losses = facts["history"], tensors["losses"]
        self.network.load_state_dict(tensors["network"])
        self.average.network.load_state_dict(tensors["weights"])
        self.average.updates = facts["state"]["updates"]
        groups = self.optimizer.state_dict()["param_groups"]
        self.optimizer.load_state_dict({"state": tensors["optimizer"], "param_groups": groups})

    # -- steps ------------------------------------------------------------------------------------------
    def progress(self, step=None):
        steps = self.epoch * len(self.loader) + (self.step if step is None else step)
        return self.plan.progress(steps, len(self.loader), self.seconds)

    def augmentation_at(self, step):
        progress = self.progress(step)
        return Augmentation(mosaic=self.settings.mosaic if progress < 1 - self.settings.plain else 0.0,
                            window=WINDOW if progress < self.settings.cuttings else 1.0)

    def take_step(self, images, bodies):
        for group in self.optimizer.param_groups:
            group["lr"] = self.rate * rate_factor(self.progress())
        kind = torch.device(self.device).type
        with torch.autocast(kind, dtype=torch.bfloat16, enabled=self.settings.bf16):
            maps = self.network(network_input(images, self.device))
        loss, parts = detection_loss(maps, bodies.to(self.device))
        self.optimizer.zero_grad(set_to_none=True)
        (loss * len(images)).backward()
        torch.nn.utils.clip_grad_norm_(self.network.parameters(), LONGEST_GRADIENT)
        self.optimizer.step()
        self.average.update(self.network)
        parts = parts.cpu()
        if not torch.isfinite(parts).all():
            raise FloatingPointError(f"epoch {self.epoch + 1}, step {self.step + 1}: the loss is {parts.tolist()}; "
                                     "try a lower --rate")
        self.losses += parts

    def run_epoch(self):
        """To its end, or to the end of the plan. An interruption loses SAVE_SECONDS at most."""
        self.network.train()
        began = time.monotonic()
        for images, bodies in self.loader.epoch(self.epoch, self.step, self.augmentation_at):
            self.take_step(images, bodies)
            self.step += 1
            now = time.monotonic()
            self.seconds, began = self.seconds + now - began, now
            self.report.step(self)
            if self.stop:
                self.save()
                raise KeyboardInterrupt
            if self.progress() >= 1:
                break
            if now - self.saved_at > SAVE_SECONDS:
                self.save()

    def end_epoch(self):
        losses = (self.losses / max(1, self.step)).tolist()
        row = {"epoch": self.epoch + 1, "seconds": round(self.seconds, 1), "score_loss": losses[0],
               "box_loss": losses[1], "distribution_loss": losses[2], "map50": None, "map50_95": None}
        done = self.progress() >= 1
        if done or (self.epoch + 1) % self.settings.validate == 0:
            began = time.monotonic()
            row["map50"], row["map50_95"] = score(runner(self.average.network), self.validation, sizes=ALL).summary()
            self.seconds += time.monotonic() - began
        self.history.append(row)
        self.epoch, self.step, self.losses = self.epoch + 1, 0, torch.zeros(3)
        if row["map50_95"] is not None and row["map50_95"] > self.best:
            self.best = row["map50_95"]
            self.save("best.pt", with_state=False)
        self.save()
        self.report.epoch(self)
        return done

    @property
    def ended(self):
        return bool(self.history) and self.progress() >= 1

    def run(self):
        self.out.mkdir(parents=True, exist_ok=True)
        self.saved_at = time.monotonic()
        done = self.ended
        while not done:
            self.run_epoch()
            done = self.end_epoch()
