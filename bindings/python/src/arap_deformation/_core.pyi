from typing import Any

class State: ...

Session: Any
