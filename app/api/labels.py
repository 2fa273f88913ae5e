"""Names of nodes and rooms."""

from __future__ import annotations

from fastapi import APIRouter

from app.api.dependencies import ServicesDep
from app.api.models import model_detail
from app.api.schemas import LabelBody, ModelDetail
from app.services import Services
from app.storage.model_files import Edit

router = APIRouter(prefix="/models", tags=["labels"])


@router.patch("/{model_id}/nodes/{node_id}", summary="Name a node")
def label_node(model_id: str, node_id: str, body: LabelBody, services: ServicesDep) -> ModelDetail:
    """Names a node, or with null takes its name away; touching nodes of one name are one room."""
    from app.storage.label_edit import node_label

    return _edited(services, model_id, node_label(node_id, body.label or None))


@router.patch("/{model_id}/rooms/{room_id}", summary="Name a room")
def label_room(model_id: str, room_id: str, body: LabelBody, services: ServicesDep) -> ModelDetail:
    """Names all nodes of a room."""
    from app.storage.label_edit import room_label

    return _edited(services, model_id, room_label(room_id, body.label or None))


def _edited(services: Services, model_id: str, edit: Edit) -> ModelDetail:
    return model_detail(services, services.models.edit(model_id, edit, while_made=True))
