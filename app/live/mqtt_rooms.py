"""Tells an MQTT broker in which room a robot is, in the way that Home Assistant discovers sensors."""

from __future__ import annotations

import asyncio
import json
import re
from typing import Any

import aiomqtt

from app.live.hub import LiveHub
from app.live.session import LiveSession, LiveStatus
from app.settings import Settings

LOOK_S = 1.0
"""Seconds between two looks for sessions that have begun."""
SURE = 0.5
"""A room less probable than this is told as `unknown`."""
NOWHERE = "unknown"


async def announce_rooms(client: aiomqtt.Client, live: LiveHub, settings: Settings) -> None:
    """Tells the rooms of all localization sessions until it is cancelled."""
    followed: dict[str, asyncio.Task[None]] = {}
    async with asyncio.TaskGroup() as tasks:
        while True:
            for record in live.records():
                session = live.running(record.id)
                running = record.status is LiveStatus.RUNNING and record.mode == "localization"
                if session is not None and running and record.id not in followed:
                    task = tasks.create_task(_follow(client, session, settings))
                    followed[record.id] = task
            await asyncio.sleep(LOOK_S)


async def _follow(client: aiomqtt.Client, session: LiveSession, settings: Settings) -> None:
    name = topic_name(session.record.origin.rpartition("/")[2] or session.record.name)
    topic = f"{settings.mqtt_topic}/{name}/room"
    if settings.home_assistant:
        for kind, config in discovery(session.record.name, name, topic).items():
            place = f"homeassistant/sensor/echorooms_{name}/{kind}/config"
            await client.publish(place, json.dumps(config), qos=1, retain=True)
    listener = session.events.listen()
    try:
        while (event := await listener.take())["type"] != "ended":
            if event["type"] == "belief":
                await client.publish(topic, json.dumps(room_of(event)), qos=1, retain=True)
    finally:
        session.events.leave(listener)


def room_of(belief: dict[str, Any]) -> dict[str, Any]:
    """What a belief event means: the room's name, `unknown` while none is probable."""
    sure = belief["probability"] >= SURE and belief["probability"] > belief["unknown"]
    node = belief["current_room"]
    return {
        "room": (belief.get("label") or node) if sure else NOWHERE,
        "node": node,
        "probability": round(belief["probability"], 4),
        "entropy": round(belief["entropy"], 4),
        "t": belief["t"],
    }


def discovery(name: str, key: str, topic: str) -> dict[str, dict[str, Any]]:
    """The retained messages, by sensor, from which Home Assistant makes a robot with two sensors."""
    device = {"identifiers": [f"echorooms_{key}"], "name": name, "manufacturer": "EchoRooms"}

    def sensor(kind: str, what: str, template: str) -> dict[str, Any]:
        return {
            "name": what,
            "unique_id": f"echorooms_{key}_{kind}",
            "object_id": f"{key}_{kind}",
            "state_topic": topic,
            "value_template": template,
            "device": device,
        }

    room = sensor("room", "Room", "{{ value_json.room }}")
    confidence = sensor("confidence", "Confidence", "{{ (100 * value_json.probability) | round }}")
    return {
        "room": room | {"json_attributes_topic": topic, "icon": "mdi:robot-vacuum"},
        "confidence": confidence | {"unit_of_measurement": "%", "state_class": "measurement"},
    }


def topic_name(name: str) -> str:
    """A robot's name as a level of a topic."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", name).strip("_") or "robot"
