"""What routes ask for."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Query
from starlette.requests import HTTPConnection

from app.services import Services
from app.storage.search import Sorting


def get_services(connection: HTTPConnection) -> Services:
    """The services of the app that got the request."""
    services: Services = connection.app.state.services
    return services


def get_sorting(
    sort: Annotated[str, Query(description="field to sort by; - in front for descending")] = (
        "-created"
    ),
) -> Sorting:
    """The order of a list."""
    return Sorting.of(sort)


ServicesDep = Annotated[Services, Depends(get_services)]
SortingDep = Annotated[Sorting, Depends(get_sorting)]
SearchQuery = Annotated[str, Query(max_length=200, description="words to search for")]
