import 'rock-field';
