# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random place, period and light: the sections `site`, `period`, `sun` and `light` of a study, and their files."""

import datetime
import math
import os

# Latitude, longitude [degrees], time zone: both hemispheres, tropics, poles, odd zones.
PLACES = [(49.7475, 13.3776, "Europe/Prague"), (-33.87, 151.2, "Australia/Sydney"), (0.0, -78.5, "America/Guayaquil"),
          (1.35, 103.8, "Asia/Singapore"), (69.65, 18.96, "Europe/Oslo"), (78.2, 15.6, "Arctic/Longyearbyen"),
          (-90.0, 0.0, "UTC"), (90.0, 0.0, "UTC"), (23.4364, 120.0, "Asia/Taipei"), (-23.4364, -46.6, "America/Sao_Paulo"),
          (27.7, 85.3, "Asia/Kathmandu"), (-43.9, -176.5, "Pacific/Chatham"), (-31.5, 159.1, "Australia/Lord_Howe"),
          (21.3, -157.8, "Pacific/Honolulu"), (-13.8, -171.8, "Pacific/Apia"), (52.5, 13.4, "+01:00"), (0.0, 180.0, "-12:00"),
          (-54.8, -68.3, "America/Argentina/Ushuaia"), (66.5622, 25.7, "Europe/Helsinki")]
# Days of the year that are special to the sun or to clocks.
DAYS = ["03-20", "03-21", "06-21", "09-23", "12-21", "12-22", "03-29", "10-25", "04-05", "10-04", "01-01", "12-31", "02-28"]
NAMED = ["march_equinox", "june_solstice", "september_equinox", "december_solstice"]
STEPS_MIN = [0.5, 1, 5, 7, 10, 13.5, 15, 20, 30, 40, 45, 60, 60, 60, 90, 97, 120, 240]
DAY_MIN = 24 * 60


def clock(minutes):
    """Time of day, with seconds where it has some."""
    seconds = round(minutes * 60)
    text = f"{seconds // 3600:02}:{seconds // 60 % 60:02}"
    return text if seconds % 60 == 0 else f"{text}:{seconds % 60:02}"


def random_day(random):
    year = random.choice([2026, 2026, 2024, random.randint(1950, 2037), random.choice([1900, 2100, 2150])])
    return f"{year}-{random.choice(DAYS)}"


def random_site(random, crs):
    """`crs`: of the scene, where it has one."""
    latitude, longitude, zone = random.choice(PLACES)
    if crs:
        return {"crs": crs, "timezone": random.choice(["UTC", "Europe/Prague"])}
    site = {"latitude_deg": latitude, "longitude_deg": longitude, "timezone": zone}
    if random.random() < 0.3:
        site["north_deg"] = random.choice([90, -45, 180, round(random.uniform(-360, 360), 2)])
    if random.random() < 0.3:
        site["elevation_m"] = random.choice([-400, 310, 4000])
    return site


def random_horizon(random, folder):
    rows = [f"{azimuth},{random.choice([0, 2, 12, 35])}" for azimuth in range(0, 360, 30)]
    with open(os.path.join(folder, "hills.csv"), "w", encoding="utf-8") as file:
        file.write("azimuth_deg,elevation_deg\n" + "\n".join(rows) + "\n")
    return "hills.csv"


def sky_of_hour(random, hour):
    """A day of any place: DNI, DHI, GHI of an hour of local time [W m-2]."""
    height = max(0.0, math.cos((hour - 12) * math.pi / 12))
    dni = round(800 * height ** 0.3 * random.random()) if height > 0 else 0
    dhi = round(150 * height) if random.random() < 0.9 else 0
    return dni, dhi, round(dni * height + dhi)


def write_csv_weather(random, path, first_day, days, gap):
    """Rows of half an hour or an hour with offsets; `gap`: some values are missing."""
    step_min = random.choice([30, 60])
    columns = random.choice([(0, 1), (0, 1, 2), (2,), (0, 2), (1, 2)])
    names = [("dni_w_m2", "dhi_w_m2", "ghi_w_m2")[c] for c in columns]
    start = datetime.datetime.fromisoformat(first_day)
    lines = ["time," + ",".join(names)]
    for row in range(days * DAY_MIN // step_min):
        light = sky_of_hour(random, row * step_min / 60 % 24)
        values = ["" if gap and row % 9 == 5 else str(light[c]) for c in columns]
        lines.append(",".join([(start + datetime.timedelta(minutes=row * step_min)).strftime("%Y-%m-%dT%H:%MZ"), *values]))
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def write_epw(random, path, latitude, longitude):
    """A typical year; its zone is that of the longitude."""
    lines = [f"LOCATION,NOWHERE,-,-,Synthetic,0,{latitude},{longitude},{round(longitude / 15)},100", "DESIGN CONDITIONS,0",
             "TYPICAL/EXTREME PERIODS,0", "GROUND TEMPERATURES,0", "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0", "COMMENTS 1,",
             "COMMENTS 2,", "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31"]
    day = datetime.date(2001, 1, 1)
    while day.year == 2001:
        for hour in range(1, 25):
            dni, dhi, ghi = sky_of_hour(random, hour - 0.5)
            lines.append(f"{1980 + day.month},{day.month},{day.day},{hour},60,A7,10,5,70,95300,0,1415,300,"
                         f"{ghi},{dni},{dhi},0,0,0,0")
        day += datetime.timedelta(days=1)
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def random_period(random, most):
    """With at most so many intervals."""
    count, step = random.randint(1, most), random.choice(STEPS_MIN)
    kind = random.choice(["days", "days", "range", "range", "instants"])
    if kind == "instants":
        day = random_day(random)
        minutes = sorted(random.sample(range(0, DAY_MIN), min(count, 12)))
        zone = random.choice(["", "Z", "+02:00"])
        return {"instants": [f"{day}T{clock(m)}{zone}" for m in minutes], "interval_min": random.choice([1, 60, 7.5])}
    if kind == "days":
        days = random.sample(range(len(DAYS)), random.choice([1, 1, 2]))
        days = sorted(f"2026-{DAYS[d]}" for d in days) if random.random() < 0.7 else [
            random.choice([random_day(random), f"{random.choice(NAMED)} 2026"])]
        count = max(1, min(count // len(days), int(DAY_MIN // step)))
        begin = random.randint(0, int(DAY_MIN - count * step))
        if random.random() < 0.2 and DAY_MIN % step == 0 and DAY_MIN / step * len(days) <= most:
            return {"days": days, "step_min": step}
        return {"days": days, "from": clock(begin), "to": clock(begin + count * step), "step_min": step}
    day = datetime.datetime.fromisoformat(random_day(random))
    begin = day + datetime.timedelta(minutes=random.randint(0, DAY_MIN))
    end = begin + datetime.timedelta(seconds=60 * count * step)
    form = "%Y-%m-%dT%H:%M:%SZ"
    return {"start": begin.strftime(form), "end": end.strftime(form), "step_min": step}


def random_positions(random, count):
    heights = [-5, 0, 0.5, 10, 30, 60, 89.99, 90]
    return {"positions": [{"azimuth_deg": random.choice([0, 90, 180, 360, round(random.uniform(0, 360), 3)]),
                           "elevation_deg": random.choice(heights), "interval_min": random.choice([1, 60, 0.25])}
                          for _ in range(count)]}


def random_sky(random):
    sky = random.choice(["perez", "perez", "cie_general", "cie_clear", "cie_overcast", "preetham", "uniform"])
    light = {"sky": sky, "far_ground_albedo": random.choice([0, 0.2, 0.2, 1])}
    if sky == "cie_general":
        light["sky_type"] = random.randint(1, 15)
    if sky == "preetham":
        light["turbidity"] = random.choice([2, 3, 6, 10])
    return light


class RandomLight:
    """`sections` of the study; `is_of_weather_file`: the period is that of its records."""

    def __init__(self, random, folder, crs, most_intervals):
        self.random, self.folder = random, folder
        self.sections = {"site": random_site(random, crs), "light": random_sky(random)}
        self.is_of_weather_file = False
        random.choice([self.clear_sky, self.clear_sky, self.fixed, self.positions, self.weather])(most_intervals)
        if random.random() < 0.5:
            self.sections["sun"] = {"refraction": random.choice(["none", "spa", "bennett"]),
                                    "disk": random.choice(["point", "finite"]), "ut1_utc": random.choice(["table", "zero"])}
        if random.random() < 0.12:
            self.sections["site"]["horizon"] = random_horizon(random, folder)

    def clear_sky(self, most):
        random, light = self.random, self.sections["light"]
        light.update(source="clear_sky", model=random.choice(["ineichen", "ineichen", "bird", "haurwitz"]))
        if light["model"] == "ineichen":
            light["linke_turbidity"] = random.choice([1, 3, 20, [2 + 0.1 * m for m in range(12)]])
        if light["sky"] == "preetham" and random.random() < 0.5:
            light["sky_scale"] = "absolute"
        self.sections["period"] = random_period(random, most)

    def fixed(self, most):
        self.sections["light"].update(source="fixed", dni_w_m2=self.random.choice([0, 800, 1361.5]),
                                      dhi_w_m2=self.random.choice([0, 1, 120]))
        self.sections["period"] = random_period(self.random, most)

    def positions(self, most):
        self.fixed(most)
        self.sections["period"] = random_positions(self.random, self.random.randint(1, min(most, 9)))
        if "crs" not in self.sections["site"]:
            del self.sections["site"]

            self.sections["site"] = {"north_deg": 30} if self.random.random() < 0.5 else {}

    def weather(self, most):
        random, light, site = self.random, self.sections["light"], self.sections["site"]
        light.update(source="weather")
        if random.random() < 0.3 and "crs" not in site:
            light["weather"] = "year.epw"
            write_epw(random, os.path.join(self.folder, "year.epw"), site["latitude_deg"], site["longitude_deg"])
            self.sections["period"] = random_period(random, most)
            return
        gap = random.random() < 0.3
        day = f"2026-{random.choice(DAYS)}"
        write_csv_weather(random, os.path.join(self.folder, "weather.csv"), day, 2, gap)
        light.update(weather="weather.csv", stamp=random.choice(["start", "middle", "end"]),
                     decomposition=random.choice(["erbs", "disc"]))
        if gap:
            light["missing"] = random.choice(["interpolate", "zero"])
        if random.random() < 0.4:
            self.is_of_weather_file = True
            self.sections["period"] = {"year_of": "weather"}
            return
        begin = datetime.datetime.fromisoformat(day) + datetime.timedelta(minutes=random.randint(120, DAY_MIN))
        step = random.choice([s for s in STEPS_MIN if s <= 120])
        end = begin + datetime.timedelta(seconds=60 * step * random.randint(1, min(most, 8)))
        form = "%Y-%m-%dT%H:%M:%SZ"
        self.sections["period"] = {"start": begin.strftime(form), "end": end.strftime(form), "step_min": step}
