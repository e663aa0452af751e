# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Weather that never was: a clear year in Pilsen, as EPW and as WEA."""

import math

LATITUDE_DEG, LONGITUDE_DEG = 49.75, 13.38
DAYS = (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)


def hours():
    """Month, day, hour that begins, and direct normal, diffuse and global horizontal irradiance in W/m²."""
    latitude = math.radians(LATITUDE_DEG)
    for day in range(365):
        month = next(m for m in range(12) if day < sum(DAYS[:m + 1]))
        declination = math.radians(23.45 * math.sin(2 * math.pi * (284 + day + 1) / 365))
        for hour in range(24):
            height = (math.sin(latitude) * math.sin(declination) + math.cos(latitude) * math.cos(declination) *
                      math.cos(math.radians(15 * (hour + 0.5 - 12))))
            direct, diffuse = (800, 100) if height > 0.05 else (0, 0)
            yield month + 1, day - sum(DAYS[:month]) + 1, hour, direct, diffuse, round(direct * max(height, 0) + diffuse)


def epw():
    head = [f"LOCATION,Pilsen,-,CZE,none,114480,{LATITUDE_DEG},{LONGITUDE_DEG},1.0,310.0", "DESIGN CONDITIONS,0",
            "TYPICAL/EXTREME PERIODS,0", "GROUND TEMPERATURES,0", "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0", "COMMENTS 1,",
            "COMMENTS 2,", "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31"]
    rows = [f"2001,{month},{day},{hour + 1},0,?,10,5,70,97000,0,0,300,{all_light},{direct},{diffuse}" + ",0" * 19
            for month, day, hour, direct, diffuse, all_light in hours()]
    return "\n".join(head + rows) + "\n"


def wea():
    """Longitude and zone count to the west there."""
    head = ["place Pilsen", f"latitude {LATITUDE_DEG}", f"longitude {-LONGITUDE_DEG}", "time_zone -15", "site_elevation 310.0",
            "weather_data_file_units 1"]
    rows = [f"{month} {day} {hour + 0.5:.3f} {direct} {diffuse}" for month, day, hour, direct, diffuse, _ in hours()]
    return "\n".join(head + rows) + "\n"
