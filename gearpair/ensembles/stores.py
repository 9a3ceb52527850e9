"""Results block by block into a Zarr store: larger than memory, spread over processes, resumed after a kill."""

from __future__ import annotations

import errno
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from functools import cache, partial
from hashlib import sha256
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeGuard
from warnings import warn

import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from gearpair._checks import checked
from gearpair._locks import held
from gearpair.ensembles.datasets import axis_attributes, variables_of, with_numbers

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client
    from zarr import Group

BLOCK_POINTS = 2**16  # motions of a block, unless one row has more: some seconds of work, some megabytes
NO_LOCKS = {errno.ENOSYS, errno.ENOTSUP, errno.ENOLCK}  # as on some clusters


class MotionGrid(Protocol):
    """A grid of motions that can be computed in any parts and always comes out the same."""

    @property
    def axes(self) -> dict[str, NDArray[np.float64]]:
        """Names and values of the dimensions; blocks are cut along the first."""

    @property
    def identity(self) -> dict[str, str]:
        """Everything that the numbers depend on, by name."""

    def columns(self, first: int, last: int, *, cores: bool = True) -> dict[str, NDArray[Any]]:
        """The results for rows `first` to `last` of the first axis, as codes; on one core only where so asked."""


def by_store(store: str | Path | None, client: Client | None) -> TypeGuard[str | Path]:
    """Whether a result goes by way of a store; an error that says what is missing where it could not."""
    if store is None and client is not None:
        raise ValueError("a client needs a store to write to, on a path that all its workers see: give store, too")
    if store is not None and find_spec("zarr") is None:
        raise ImportError("a store needs zarr: pip install 'gearpair[cluster]'")
    return store is not None


def stored(
    grid: MotionGrid,
    path: str | Path,
    rest: Callable[[Group], None] = lambda group: None,
    *,
    client: Client | None = None,
    progress: bool = False,
) -> xr.Dataset:
    """What the store at `path` holds once all of `grid` and the `rest` are in it; what is there is not computed again.

    Blocks are computed one by one; with a `client`, on its workers. A block counts once all of it is written, so a run
    killed at any moment goes on where it was. Every chunk of the store belongs to one block, and only one worker has
    it. The store belongs to the process that calls until `rest`, which writes what needs all blocks, has returned.

    Raises
    ------
    ValueError
        For a store made with other arguments or another engine: it says which.
    RuntimeError
        Where another process is writing the store.
    FileNotFoundError
        For a store that has lost a chunk: it says which.
    """
    path = Path(path)
    group = _finished(grid, path)
    if group is None:
        with _writing(path):
            group = _opened(grid, path)
            group.attrs["complete"] = False
            _fill(grid, group, path, client, progress)
            rest(group)
            group.attrs["complete"] = True
    _check_chunks(grid, group, path, group.array_keys())
    return opened_dataset(path)


@contextmanager
def _writing(path: Path) -> Iterator[None]:
    """The store at `path` for this process alone, as far as the file system can tell."""
    path = path.resolve()
    path.parent.mkdir(parents=True, exist_ok=True)
    with ExitStack() as stack:
        try:
            stack.enter_context(held(path.parent / f".{path.name}.lock"))
        except BlockingIOError:
            raise RuntimeError(
                f"another run is writing the store at {path}: wait for it, or give another path"
            ) from None
        except OSError as error:
            if error.errno not in NO_LOCKS:
                raise
            warn(f"the file system of {path} has no locks: let no other run write this store", stacklevel=2)
        yield


def _fill(grid: MotionGrid, group: Group, path: Path, client: Client | None, progress: bool) -> None:
    """Compute the blocks that are not there yet."""
    finished = group["done"][:].tolist()
    todo = [i for i, done in enumerate(finished) if not done]
    with tqdm(total=len(finished), initial=len(finished) - len(todo), unit="block", disable=not progress) as bar:
        for _ in map(partial(store_block, grid, str(path)), todo) if client is None else _by(client, grid, path, todo):
            bar.update()
    _check_chunks(grid, group, path, [*grid.axes, *grid.columns(0, 0)])


def _by(client: Client, grid: MotionGrid, path: str | Path, todo: list[int]) -> Iterator[None]:
    """Blocks stored by the workers of a `client`, in any order."""
    from distributed import as_completed

    shared = client.scatter(grid, broadcast=True, hash=False)
    same = [shared] * len(todo), [str(path)] * len(todo)
    return (f.result() for f in as_completed(client.map(store_block, *same, todo, cores=False, pure=False)))


def store_block(grid: MotionGrid, path: str, i: int, *, cores: bool = True) -> None:
    """Compute block `i` and write it; its mark comes last."""
    import zarr

    group = zarr.open_group(path, mode="r+")
    first, last = _blocks(grid, group)[i]
    for name, column in grid.columns(first, last, cores=cores).items():
        array = _whole(group[name])
        array[first:last] = column.reshape(last - first, *array.shape[1:])
    group["done"][i] = True


def add_column(grid: MotionGrid, group: Group, name: str, dtype: Any) -> Any:
    """An array of the store for one more number per motion, made anew."""
    return _whole(_create(grid, group, name, np.empty(0, dtype)))


def column_of(group: Group, name: str) -> Any:
    """An array of the store that is there, to write to."""
    return _whole(group[name])


def add_table(group: Group, variables: Mapping[str, Any]) -> None:
    """Small variables besides those of each motion."""
    for name, (dims, values, facts) in variables.items():
        _write(group, name, dims, values, facts)


def _write(group: Group, name: str, dims: tuple[str, ...], values: NDArray[Any], facts: Mapping[str, Any]) -> None:
    kind: dict[str, Any] = {"shape": values.shape, "dtype": values.dtype, "dimension_names": dims, "attributes": facts}
    _whole(group.create_array(name, **kind, overwrite=True))[:] = values


def _whole(array: Any) -> Any:
    """The array, whose chunks are written even where they are all zero: one that is not there has been lost."""
    return array.with_config({"write_empty_chunks": True})


def _check_chunks(grid: MotionGrid, group: Group, path: Path, names: Iterable[str]) -> None:
    """Raise a FileNotFoundError for the first chunk of the arrays `names` that is not there: zarr reads zeros then.

    A lost mark of ``done`` needs no error: its block is computed again.
    """
    for name in names:
        data = group[name].metadata
        by_block = data.dimension_names == tuple(grid.axes) and name not in grid.axes
        for place in np.ndindex(group[name].cdata_shape) if name != "done" else ():
            chunk = path / name / data.encode_chunk_key(place)
            if not chunk.exists():
                remove = path / "done" / group["done"].metadata.encode_chunk_key(place[:1]) if by_block else path
                raise FileNotFoundError(
                    f"the store at {path} has lost block {place[0]} of {name}: put {chunk} back, or remove {remove}, "
                    "and the same call computes it again"
                )


def read_blocks(grid: MotionGrid, group: Group, names: list[str]) -> Any:
    """For each block in turn its first and last row and the columns `names`, flat."""
    for first, last in _blocks(grid, group):
        yield first, last, {name: group[name][first:last].ravel() for name in names}


def opened_dataset(path: str | Path) -> xr.Dataset:
    """What a store holds, read when it is asked for; codes stay codes, see `decoded`."""
    import xarray as xr

    whole = xr.open_zarr(path, chunks=None, consolidated=False, mask_and_scale=False)
    result = whole.drop_vars("done")
    result.attrs = {"oscillator": result.attrs["oscillator"]}
    return with_numbers(result)


@checked
def decoded(result: xr.Dataset) -> xr.Dataset:
    """A stored result in memory, with words for its codes: what the same call gives without a store.

    Examples
    --------
    >>> from gearpair.ensembles import basins
    >>> from gearpair.oscillator import Oscillator
    >>> decoded(basins(Oscillator(), [1.0], [0.0])).status.values.tolist()
    [['periodic']]
    """
    result = result.load()
    for name in list(result):
        words = result[name].attrs.get("flag_meanings")
        if words is not None:
            column = result[name]
            spelled = np.array(["" if word == "-" else word for word in words.split(" ")])[column.values + 1]
            facts = {key: fact for key, fact in column.attrs.items() if not key.startswith("flag_")}
            result = result.assign({name: (column.dims, spelled, facts)})
    return result


@cache
def engine() -> str:
    """What numbers depend on besides the arguments: the sources that make them and the compiler."""
    folder = Path(__file__).parents[1]
    sources = sorted(path for room in ("_flow", "motion", "ensembles") for path in (folder / room).glob("*.py"))
    digest = sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()[:16]
    return f"sources {digest}, numba {version('numba')}"


def fingerprint(values: NDArray[Any]) -> str:
    """A short text that tells arrays apart."""
    return f"{len(values)} numbers, {sha256(np.ascontiguousarray(values).tobytes()).hexdigest()[:16]}"


def _identity(grid: MotionGrid) -> dict[str, str]:
    axes = {name: fingerprint(values) for name, values in grid.axes.items()}
    return {**grid.identity, **axes, "engine": engine()}


def _finished(grid: MotionGrid, path: Path) -> Group | None:
    """The store at `path` if it is complete, else None; nothing is written, so that many may read it at once."""
    import zarr

    if not (path / "zarr.json").exists():
        return None
    group = zarr.open_group(str(path), mode="r")
    _check_identity(grid, group, path)
    return group if group.attrs.get("complete") and group["done"][:].all() else None


def _check_identity(grid: MotionGrid, group: Group, path: Path) -> None:
    """Raise a ValueError for the store of another call."""
    identity, made = _identity(grid), group.attrs.get("identity", {})
    for name in (*identity, *made) if made else ():
        if made.get(name) != identity.get(name):
            raise ValueError(
                f"the store at {path} was made with another {name} ({made.get(name)}, now {identity.get(name)}): "
                "give another path, or remove it"
            )


def _opened(grid: MotionGrid, path: Path) -> Group:
    """The store at `path` to write to, laid out where it is new."""
    import zarr

    if path.exists() and any(path.iterdir()) and not (path / "zarr.json").exists():
        raise ValueError(f"store must be a new path or one of gearpair's own, got {path}, which holds something else")
    group = zarr.open_group(str(path), mode="a")
    _check_identity(grid, group, path)
    if not group.attrs.get("identity"):
        _lay_out(grid, group)
        group.attrs["identity"] = _identity(grid)  # last: without it the next run begins again
    return group


def _blocks(grid: MotionGrid, group: Group) -> list[tuple[int, int]]:
    """First and last row of each block of a store."""
    n, rows = len(next(iter(grid.axes.values()))), int(group.attrs["rows"])
    return [(first, min(first + rows, n)) for first in range(0, n, rows)]


def _lay_out(grid: MotionGrid, group: Group) -> None:
    """All arrays of a store, empty but for the axes."""
    lengths = [len(values) for values in grid.axes.values()]
    group.attrs["rows"] = max(1, min(lengths[0], BLOCK_POINTS // max(1, int(np.prod(lengths[1:])))))
    group.attrs["oscillator"] = grid.identity["oscillator"]
    for name, column in grid.columns(0, 0).items():
        _create(grid, group, name, column)
    for name, values in grid.axes.items():
        _write(group, name, (name,), values, axis_attributes(name))
    blocks = len(_blocks(grid, group))
    group.create_array("done", shape=(blocks,), chunks=(1,), dtype=bool, dimension_names=("block",), overwrite=True)


def _create(grid: MotionGrid, group: Group, name: str, empty: NDArray[Any]) -> Any:
    shape = tuple(len(values) for values in grid.axes.values())
    facts = variables_of({name: empty}, (name,), (0,), coded=True)[name][2]
    chunks = (int(group.attrs["rows"]), *shape[1:])
    return group.create_array(
        name, shape=shape, chunks=chunks, dtype=empty.dtype, dimension_names=tuple(grid.axes), attributes=facts,
        overwrite=True,
    )  # fmt: skip
