"""The exceptions of Pharos."""


class InputError(ValueError):
    """The input is wrong: a config, scene, mesh, image or model.

    The message is one line. `file`, `line` and `column` say where the flaw is, as far as that is known;
    lines and columns count from 1. In a config that is a dictionary, `file` is the path of keys, such as
    "film.width". `flaws` lists the messages of all flaws that were found, this one first.
    """

    def __init__(self, message, file=None, line=None, column=None, flaws=None):
        super().__init__(message)
        self.file = file
        self.line = line
        self.column = column
        self.flaws = [message] if flaws is None else flaws


class RunError(RuntimeError):
    """The input is right, but the work could not be done, as when a disk is full."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a render. `result` is what `render` would have returned: the samples so far."""

    def __init__(self, result):
        super().__init__("the render was interrupted; 'result' has the samples so far")
        self.result = result
