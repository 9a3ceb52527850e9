"""Kernels that are there at once: forked from a process that has imported what every submission imports.

A kernel of its own for every submission keeps students apart. That each imports numba and matplotlib anew does not,
and it takes longer than most of what students compute. So one process, the nursery, imports them, and every kernel
begins as a copy of it. The nursery runs no code of a student's, and knows neither tests nor gradebook.
"""

import atexit
import json
import os
import select
import signal
import subprocess
import sys
from functools import cache

from jupyter_client.manager import AsyncKernelManager

KERNEL = ["-m", "ipykernel_launcher"]


class NurseryKernelManager(AsyncKernelManager):
    """Takes its kernels from the nursery where it can, and otherwise starts them as ever."""

    async def _async_launch_kernel(self, kernel_cmd, **options):
        kernel = forked(kernel_cmd, options.get("env", os.environ), options.get("cwd") or os.getcwd())
        if kernel is None:
            await super()._async_launch_kernel(kernel_cmd, **options)
            return
        local = self.provisioner
        local.process, local.pid, local.pgid = kernel, kernel.pid, kernel.pid
        self._reconcile_connection_info(local.connection_info)


class Forked:
    """The process of a kernel, which is no child of this one: of `subprocess.Popen` what jupyter_client asks for."""

    stdin = stdout = stderr = None

    def __init__(self, pid):
        self.pid = pid
        self._handle = os.pidfd_open(pid)
        self._gone = False

    def poll(self):
        """None while it lives, then 0: how it ended is not known here."""
        if not self._gone and select.select([self._handle], [], [], 0)[0]:
            self._gone = True
            os.close(self._handle)
        return 0 if self._gone else None

    def wait(self):
        if not self._gone:
            select.select([self._handle], [], [])
        return self.poll()

    def send_signal(self, number):
        if self.poll() is None:
            signal.pidfd_send_signal(self._handle, number)

    def terminate(self):
        self.send_signal(signal.SIGTERM)

    def kill(self):
        self.send_signal(signal.SIGKILL)


@cache
def nursery():
    """The one process, begun at the first call; it ends when this one does. None where it is not to be had."""
    if sys.platform != "linux":  # elsewhere a copy of a process that has loaded so much is not safe
        return None
    pipe = subprocess.PIPE
    begun = subprocess.Popen([sys.executable, __file__], stdin=pipe, stdout=pipe, start_new_session=True, text=True)
    atexit.register(begun.wait)
    atexit.register(begun.kill)  # which is called first; a kernel that is still there ends with its parent
    return begun


def forked(command, environment, folder):
    """A kernel out of the nursery, begun by `command` if it were a new process; None where it takes one."""
    if command[0] != sys.executable or command[1:3] != KERNEL or nursery() is None:
        return None
    try:
        print(json.dumps([command[2:], dict(environment), str(folder)]), file=nursery().stdin, flush=True)
        return Forked(int(nursery().stdout.readline()))
    except (OSError, ValueError):  # it has ended
        return None


def serve():
    """In the nursery: import, then a kernel for every line that comes."""
    sys.path.remove(os.path.dirname(os.path.abspath(__file__)))  # no submission imports from here
    # Both are looked at when the modules below are imported.
    os.environ |= {"JPY_PARENT_PID": str(os.getpid()), "MPLBACKEND": "module://matplotlib_inline.backend_inline"}
    import ipykernel.kernelapp  # noqa: F401
    import matplotlib.pyplot  # noqa: F401

    import gearpair.teaching  # noqa: F401

    living, loaded = set(), False
    for line in sys.stdin:
        living -= {pid for pid in living if os.waitpid(pid, os.WNOHANG)[0]}
        pid = os.fork()
        if pid == 0:
            become_a_kernel(*json.loads(line))
        living.add(pid)
        if not loaded:  # while the first kernel is at work; a class that needs none of it loses a second
            load_what_is_compiled()
            loaded = True


def load_what_is_compiled():
    """Compiled code out of numba's cache, which takes each process a second again."""
    from tqdm import tqdm

    from gearpair.study.first_hour import CALLS

    tqdm.monitor_interval, usual = 0, tqdm.monitor_interval  # its thread would not be there in a copy
    for call in CALLS:
        call()
    tqdm.monitor_interval = usual


def become_a_kernel(arguments, environment, folder):
    """In a copy of the nursery: what a new process has of its own, and nothing that leads to the nursery."""
    import numpy as np
    from ipykernel.kernelapp import launch_new_instance

    os.setsid()
    os.write(1, f"{os.getpid()}\n".encode())
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(2, 1)
    os.close(nothing)
    parent = os.environ["JPY_PARENT_PID"]
    os.environ.clear()
    os.environ.update({**environment, "JPY_PARENT_PID": parent})
    os.chdir(folder)
    np.random.seed()  # what Python itself draws from begins anew in every copy  # noqa: NPY002
    sys.argv = arguments
    launch_new_instance()
    os._exit(0)


if __name__ == "__main__":
    serve()
