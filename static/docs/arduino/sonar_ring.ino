// A ring of HC-SR04 ultrasonic sensors for `echorooms bridge`: Arduino Mega, ESP32 and the like.
//
// Every 250 ms it prints one line at 115200 baud:
//   millis;x_mm;y_mm;heading_mrad;r1;r2;...;rN*HH
// r1..rN: millimetres in the order of the ring file, counter-clockwise, 0 = no echo;
// HH: exclusive or of all characters before the star.
//
// Wiring: VCC of all sensors to 5 V, GND to GND, TRIG and ECHO as below. On an ESP32 every ECHO
// needs a voltage divider (1 kOhm to the pin, 2 kOhm to ground): its pins do not stand 5 V.

const int SONARS = 8;
const int TRIG[SONARS] = {22, 24, 26, 28, 30, 32, 34, 36};
const int ECHO[SONARS] = {23, 25, 27, 29, 31, 33, 35, 37};
const unsigned long PERIOD_MS = 250;
const unsigned long LISTEN_US = 24000;  // 4 m there and back

// Wheels with encoders (one channel each, on interrupt pins). Without them leave 0: the pose stays
// where it is, and the server can draw beams but no map.
const int LEFT_PIN = 2, RIGHT_PIN = 3;
const float MM_PER_TICK = 0.0;      // circumference / ticks of a turn
const float WHEEL_BASE_MM = 150.0;  // between the wheels
volatile long leftTicks = 0, rightTicks = 0;
volatile int leftSign = 1, rightSign = 1;  // set these where you drive the motors

float x = 0, y = 0, heading = 0;
long oldLeft = 0, oldRight = 0;

void leftTick() { leftTicks += leftSign; }
void rightTick() { rightTicks += rightSign; }

void setup() {
  Serial.begin(115200);
  for (int i = 0; i < SONARS; i++) {
    pinMode(TRIG[i], OUTPUT);
    pinMode(ECHO[i], INPUT);
  }
  pinMode(LEFT_PIN, INPUT_PULLUP);
  pinMode(RIGHT_PIN, INPUT_PULLUP);
  attachInterrupt(digitalPinToInterrupt(LEFT_PIN), leftTick, RISING);
  attachInterrupt(digitalPinToInterrupt(RIGHT_PIN), rightTick, RISING);
}

void odometry() {
  noInterrupts();
  long left = leftTicks, right = rightTicks;
  interrupts();
  float dl = (left - oldLeft) * MM_PER_TICK, dr = (right - oldRight) * MM_PER_TICK;
  oldLeft = left;
  oldRight = right;
  float turn = (dr - dl) / WHEEL_BASE_MM, way = (dl + dr) / 2;
  x += way * cos(heading + turn / 2);
  y += way * sin(heading + turn / 2);
  heading += turn;
}

int listen(int i) {
  digitalWrite(TRIG[i], LOW);
  delayMicroseconds(2);
  digitalWrite(TRIG[i], HIGH);
  delayMicroseconds(10);
  digitalWrite(TRIG[i], LOW);
  unsigned long us = pulseIn(ECHO[i], HIGH, LISTEN_US);
  return us * 0.1715;  // half of the speed of sound, mm per microsecond; 0: no echo
}

void loop() {
  unsigned long began = millis();
  static char line[160];
  odometry();
  int n = snprintf(line, sizeof line, "%lu;%ld;%ld;%ld", began, (long)x, (long)y, (long)(heading * 1000));
  // Sensors across the ring one after the other, so that none hears its neighbour's echo.
  int ranges[SONARS];
  for (int k = 0; k < SONARS; k++) {
    int i = (k * 3) % SONARS;  // 8 and 3 have no common divisor
    ranges[i] = listen(i);
    delay(3);
  }
  for (int i = 0; i < SONARS; i++) n += snprintf(line + n, sizeof line - n, ";%d", ranges[i]);
  byte sum = 0;
  for (int i = 0; i < n; i++) sum ^= line[i];
  char end[8];
  snprintf(end, sizeof end, "*%02X", sum);
  Serial.print(line);
  Serial.println(end);
  while (millis() - began < PERIOD_MS) delay(1);
}
