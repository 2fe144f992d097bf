"""The moves that LinuxCNC's canon for previews is told of: 2.9 has a list for each kind, 2.10 a record of floats."""

import functools

from rs274.glcanon import GLCanon

KINDS = ("traverse", "feed", "arcfeed")


def keep_moves():
    """Makes each canon keep its moves from now on, as `kept_moves`: [kind, line, start, end, tool], in order."""
    if hasattr(GLCanon, "_stage_move"):
        stock_stage = GLCanon._stage_move

        def stage(canon, line, start, end, feed, tool, kind):
            stock_stage(canon, line, start, end, feed, tool, kind)
            canon.kept_moves.append([KINDS[kind], line, start, end, tool])

        GLCanon._stage_move = stage
    stock_init = GLCanon.__init__

    def init(canon, *args, **words):
        stock_init(canon, *args, **words)
        canon.kept_moves = []
        if not hasattr(GLCanon, "_stage_move"):
            for kind in KINDS:
                setattr(canon, f"{kind}_append", functools.partial(keep, canon, kind))

    GLCanon.__init__ = init


def keep(canon, kind, move):
    """What a canon of LinuxCNC 2.9 does with a move: line, start, end, and the tool as the last."""
    getattr(canon, kind).append(move)
    line, start, end, *rest = move
    canon.kept_moves.append([kind, line, start, end, rest[-1]])
