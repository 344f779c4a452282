"""Work on several cores: the compiled kernels do not hold Python's lock."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from queue import Empty, SimpleQueue
from threading import Thread
from typing import TypeVar

T = TypeVar("T")


def in_threads(tasks: Sequence[Callable[[], T]], jobs: int) -> Iterator[T]:
    """Yield what each task returns, as soon as it has, computed by so many threads.

    An exception of a task is raised here. Threads end with the program, in the middle of a task, so
    that it can be interrupted at any time: tasks write no files.
    """
    waiting, done = SimpleQueue[Callable[[], T]](), SimpleQueue[T | BaseException]()

    def work() -> None:
        with suppress(Empty):
            while True:
                task = waiting.get_nowait()
                try:
                    done.put(task())
                except BaseException as error:
                    return done.put(error)

    for task in tasks:
        waiting.put(task)
    for _ in range(min(jobs, len(tasks))):
        Thread(target=work, daemon=True).start()
    try:
        for _ in tasks:
            result = done.get()
            if isinstance(result, BaseException):
                raise result
            yield result
    finally:
        with suppress(Empty):  # no further task begins
            while True:
                waiting.get_nowait()
