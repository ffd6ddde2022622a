"""A ROS master of one's own, and the programs that were started under it."""
import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import time
import xmlrpc.client


DIED = b"process has died"  # roslaunch's words of a node; it goes on itself
ASK, INSIST = 20.0, 5.0  # s that a program gets to end after SIGINT, after SIGTERM


class SessionError(RuntimeError):
    pass


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class RosSession:
    """Starts roscore on a free port and sets the environment so that this process, too, talks to it. On
    leaving, everything that was started is ended and the environment is as before. Logs go to `folder`, else to one that goes with the session."""

    def __init__(self, folder=None):
        self._scratch = None if folder else tempfile.TemporaryDirectory(prefix="ros_session_")
        self.folder = pathlib.Path(folder or self._scratch.name)
        self.port = free_port()
        self.master = xmlrpc.client.ServerProxy(f"http://127.0.0.1:{self.port}")
        self.running, self.started = [], 0

    def __enter__(self):
        self._before = dict(os.environ)
        os.environ.pop("ROS_HOSTNAME", None)
        os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{self.port}", ROS_IP="127.0.0.1",
                          ROS_HOME=str(self.folder / "ros"))
        try:
            core = self.start("roscore", "-p", str(self.port))
            self.require(self._master_answers, 60.0, "roscore did not come up", core)
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for process, _ in reversed(self.running):
            self._end(process)
        self.running.clear()
        os.environ.clear()
        os.environ.update(self._before)
        if self._scratch:
            self._scratch.cleanup()

    def start(self, *command):
        """Starts a program; what it writes goes to FOLDER/<number>_<its name>.log."""
        self.started += 1
        log = self.folder / f"{self.started}_{pathlib.Path(command[0]).name}.log"
        with open(log, "wb") as out:
            process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                       start_new_session=True)
        self.running.append((process, log))
        return process

    def adopt(self, process):
        """Takes a program that was started otherwise; it ends with the session."""
        self.running.append((process, None))
        return process

    def end(self, process):
        """Ends one of them before the session ends."""
        self._end(process)
        self.running = [entry for entry in self.running if entry[0] is not process]

    def launch(self, *arguments):
        return self.start("roslaunch", *map(str, arguments))

    def listen(self, topics):
        """Subscribes to topics of any type, so that stages which wait for a listener begin to work."""
        program = ("import sys, rospy; rospy.init_node('listener', anonymous=True);"
                   "kept = [rospy.Subscriber(t, rospy.AnyMsg, lambda m: None) for t in sys.argv[1:]]; rospy.spin()")
        return self.start("/usr/bin/python3", "-c", program, *topics)

    def system_state(self):
        """(publishers, subscribers, services), each a list of [name, [nodes]]."""
        return self.master.getSystemState("/session")[2]

    def topic_types(self):
        return dict(self.master.getTopicTypes("/session")[2])

    @staticmethod
    def wait(holds, seconds=60.0):
        """Whether `holds()` became true within the wall time."""
        deadline = time.monotonic() + seconds
        while not holds():
            if time.monotonic() > deadline:
                return False
            time.sleep(0.01)
        return True

    def require(self, holds, seconds, what, *needed):
        """Waits until `holds()`. Raises SessionError with the end of the logs when one of the programs
        `needed`, or a node that one of them launched, ends before, or when the wall time is up."""
        logs = [(process, log) for process, log in self.running if process in needed and log]

        def ended():
            return [log for process, log in logs if process.poll() is not None or DIED in log.read_bytes()]

        self.wait(lambda: holds() or ended(), seconds)
        if not holds():
            tail = "\n".join(log.read_text(errors="replace")[-2000:] for log in ended() or [log for _, log in logs])
            raise SessionError(f"{what}{' (it ended)' if ended() else f' within {seconds:.0f} s'}\n{tail}")

    def _master_answers(self):
        try:
            return self.master.getPid("/session")[0] == 1
        except OSError:
            return False

    @staticmethod
    def _end(process):
        """Asks first: roslaunch then ends its own nodes. What does not listen is killed with its children."""
        for end, sign, patience in ((os.kill, signal.SIGINT, ASK), (os.killpg, signal.SIGTERM, INSIST),
                                    (os.killpg, signal.SIGKILL, INSIST)):
            if process.poll() is not None:
                return
            end(process.pid, sign)
            try:
                process.wait(patience)
            except subprocess.TimeoutExpired:
                continue
